#include "csg/roof/detail/tracks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "csg/limits.h"
#include "plane/predicates.h"

namespace lamina::csg {
namespace {

using plane::Contour;
using plane::Region;

// Times and places nearer than this are one, as a share of the region's size
// and at least [mm]. Twice the second, offsets round coordinates.
constexpr double kSameShare = 1e-8;
constexpr double kSame = 2e-8;

// A corner that turns by less than this is straight.
constexpr double kStraight = 1e-9;

constexpr double kNever = std::numeric_limits<double>::infinity();

// Returns the angle from one edge to the next, at a reflex corner, in (-π, 0].
double turn_at(const Edge& before, const Edge& after) {
  const Vec2 from = before.direction();
  const Vec2 to = after.direction();
  return std::min(std::atan2(cross(from, to), glm::dot(from, to)), 0.0);
}

// Returns the angle of its direction, in (-π, π].
double angle_of(const Track& track) {
  return std::atan2(track.velocity.y, track.velocity.x);
}

// Runs the events of all tracks in the order of time.
class MotorcycleGraph {
 public:
  explicit MotorcycleGraph(const Region& region) : edges_(edges_of(region)) {
    Box2 box;
    for (const Contour& contour : region.contours) box.add(contour);
    const Vec2 size = box.size();
    same_ = std::max(kSame, kSameShare * std::max(size.x, size.y));
  }

  void start(Vec2 point, double time, const Edge& before, const Edge& after) {
    const double sum = 1 + glm::dot(before.direction(), after.direction());
    if (!(sum > 0)) return;
    if (tracks_.size() >= kMostTracks) {
      throw plane::LimitExceeded(fmt::format(
          "roof(method=\"straight\") has more than {} reflex corners",
          kMostTracks));
    }
    Track track = {point,  time,   (before.normal() + after.normal()) / sum,
                   kNever, before, after};
    track.end_time = meet_outline(track);
    const std::size_t self = tracks_.size();
    for (std::size_t other = 0; other < self; ++other) {
      expect_meeting(track, self, tracks_[other], other);
    }
    events_.push({track.end_time, self});
    tracks_.push_back(track);
    has_stopped_.push_back(false);
  }

  std::vector<Track> run() {
    while (!events_.empty()) {
      const Event event = events_.top();
      if (!meetings_.empty() && event.time > meetings_.front().time + same_) {
        ride_on();
        continue;
      }
      events_.pop();
      stop_at(event);
      if (events_.empty() && !meetings_.empty()) ride_on();
    }
    return std::move(tracks_);
  }

 private:
  static constexpr std::size_t kOutline = static_cast<std::size_t>(-1);

  // A corner comes to the outline, or to where another one is or was.
  struct Event {
    double time = 0;
    std::size_t track = 0;
    std::size_t other = kOutline;
    double other_time = 0;  // when it was there

    bool operator>(const Event& event) const { return time > event.time; }
  };

  struct Meeting {
    Vec2 point{0};
    double time = 0;
    std::vector<std::size_t> tracks;
  };

  double meet_outline(const Track& track) const {
    double earliest = kNever;
    for (const Edge& edge : edges_) {
      const Vec2 along = edge.end - edge.begin;
      const double rate = cross(track.velocity, along);
      if (rate == 0) continue;
      const Vec2 way = edge.begin - track.start;
      const double time = cross(way, along) / rate;
      const double share = cross(way, track.velocity) / rate;
      const bool meets = time > 0 && share >= 0 && share <= 1;
      if (!meets || track.start_time + time >= earliest) continue;
      if (distance_to_segment(track.start, edge.begin, edge.end) > same_) {
        earliest = track.start_time + time;
      }
    }
    return earliest;
  }

  void expect_meeting(const Track& a, std::size_t a_index, const Track& b,
                      std::size_t b_index) {
    const Vec2 way = b.start - a.start;
    const double rate = cross(a.velocity, b.velocity);
    double a_time = 0;
    double b_time = 0;
    const double lengths = glm::length(a.velocity) * glm::length(b.velocity);
    if (std::abs(rate) > kStraight * lengths) {
      a_time = a.start_time + cross(way, b.velocity) / rate;
      b_time = b.start_time + cross(way, a.velocity) / rate;
    } else {
      // Side by side, or head on.
      const double aside =
          std::abs(cross(way, a.velocity)) / glm::length(a.velocity);
      const double closing = glm::dot(a.velocity - b.velocity, a.velocity);
      if (aside > same_ || glm::dot(a.velocity, b.velocity) > 0) return;
      const Vec2 gap =
          way - b.velocity * b.start_time + a.velocity * a.start_time;
      a_time = b_time = glm::dot(gap, a.velocity) / closing;
    }
    const auto is_on = [&](const Track& track, double time) {
      return time >= track.start_time - same_ && time <= track.end_time + same_;
    };
    if (!is_on(a, a_time) || !is_on(b, b_time)) return;
    // The tracks that end where this one starts.
    if (a_time <= a.start_time + same_) return;
    if (a_time >= b_time - same_) {
      events_.push({a_time, a_index, b_index, b_time});
    } else {
      events_.push({b_time, b_index, a_index, a_time});
    }
  }

  void stop_at(const Event& event) {
    if (has_stopped_[event.track]) return;
    Track& track = tracks_[event.track];
    if (event.other != kOutline) {
      const Track& other = tracks_[event.other];
      if (event.other_time > other.end_time + same_) return;
    }
    stop(event.track, event.time);
    if (event.other == kOutline) return;
    if (event.time - event.other_time > same_) return;
    if (!has_stopped_[event.other]) stop(event.other, event.other_time);
    Meeting& meeting = meeting_at(track.at(event.time), event.time);
    for (const std::size_t i : {event.track, event.other}) {
      auto& tracks = meeting.tracks;
      if (std::find(tracks.begin(), tracks.end(), i) == tracks.end()) {
        tracks.push_back(i);
      }
    }
  }

  void stop(std::size_t track, double time) {
    tracks_[track].end_time = time;
    has_stopped_[track] = true;
  }

  Meeting& meeting_at(Vec2 point, double time) {
    for (Meeting& meeting : meetings_) {
      if (glm::distance(meeting.point, point) <= 4 * same_) return meeting;
    }
    return meetings_.emplace_back(Meeting{point, time, {}});
  }

  // Around the point of a meeting, what the corners left behind lies between
  // parts of the region; each part has a new corner.
  void ride_on() {
    std::vector<Meeting> meetings = std::move(meetings_);
    meetings_.clear();
    for (Meeting& meeting : meetings) {
      std::sort(meeting.tracks.begin(), meeting.tracks.end(),
                [&](std::size_t a, std::size_t b) {
                  return angle_of(tracks_[a]) < angle_of(tracks_[b]);
                });
      const std::size_t n = meeting.tracks.size();
      for (std::size_t i = 0; i < n; ++i) {
        const Track& here = tracks_[meeting.tracks[i]];
        const Track& next = tracks_[meeting.tracks[(i + 1) % n]];
        const Edge before = next.before;
        const Edge after = here.after;
        double between = angle_of(next) - angle_of(here);
        if (i + 1 == n) between += 2 * std::numbers::pi;
        // The region's angle there; below 0 where nothing is left between.
        const double interior = between - std::numbers::pi -
                                (turn_at(here.before, here.after) +
                                 turn_at(next.before, next.after)) /
                                    2;
        if (interior > 0 &&
            cross(before.direction(), after.direction()) < -kStraight) {
          start(meeting.point, meeting.time, before, after);
        }
      }
    }
  }

  std::vector<Edge> edges_;
  double same_ = 0;
  std::vector<Track> tracks_;
  std::vector<bool> has_stopped_;
  std::priority_queue<Event, std::vector<Event>, std::greater<>> events_;
  std::vector<Meeting> meetings_;  // of the time now
};

}  // namespace

Vec2 Edge::direction() const { return glm::normalize(end - begin); }

Vec2 Edge::normal() const { return left_of(direction()); }

double ReflexCorner::turn() const { return turn_at(before, after); }

std::vector<Edge> edges_of(const Region& region) {
  std::vector<Edge> edges;
  for (const Contour& contour : region.contours) {
    for (std::size_t i = 0; i < contour.size(); ++i) {
      edges.push_back({contour[i], contour[(i + 1) % contour.size()]});
    }
  }
  return edges;
}

std::vector<ReflexCorner> reflex_corners(const Region& region) {
  std::vector<ReflexCorner> corners;
  for (const Contour& contour : region.contours) {
    const std::vector<Edge> edges = edges_of(Region{{contour}});
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Edge& after = edges[(i + 1) % edges.size()];
      if (cross(edges[i].direction(), after.direction()) < kStraight) {
        corners.push_back({after.begin, edges[i], after});
      }
    }
  }
  return corners;
}

std::vector<Track> trace_corners(const Region& region) {
  MotorcycleGraph graph(region);
  for (const ReflexCorner& corner : reflex_corners(region)) {
    graph.start(corner.point, 0, corner.before, corner.after);
  }
  return graph.run();
}

}  // namespace lamina::csg
