#pragma once
// The tracks of reflex corners: the motorcycle graph of a region.
//
// The outline moves inwards at unit speed. A reflex corner rides along its
// bisector and leaves a track; it stops where it meets an edge of the outline
// or a track that is there already. Corners that meet at one time all stop, and
// where what is left of them is reflex, one corner rides on (Huber, Held 2012).

#include <cstddef>
#include <vector>

#include "plane/region/region.h"

namespace lamina::csg {

// A straight part of an outline. The inside is on its left.
struct Edge {
  Vec2 begin{0};
  Vec2 end{0};

  Vec2 at(double share) const { return begin + share * (end - begin); }
  Vec2 direction() const;  // of unit length, as all here
  Vec2 normal() const;     // inwards
};

struct ReflexCorner {
  Vec2 point{0};
  Edge before;
  Edge after;

  double turn() const;  // from one edge to the next, in (-π, 0]
};

struct Track {
  Vec2 start{0};
  double start_time = 0;  // distance that the outline has moved [mm]
  Vec2 velocity{0};
  double end_time = 0;
  Edge before;
  Edge after;

  Vec2 at(double time) const { return start + velocity * (time - start_time); }
};

std::vector<Edge> edges_of(const plane::Region& region);

// Returns the reflex corners of all contours, and those as good as straight.
std::vector<ReflexCorner> reflex_corners(const plane::Region& region);

// Throws LimitExceeded where there are more than kMostTracks.
std::vector<Track> trace_corners(const plane::Region& region);

inline constexpr std::size_t kMostTracks = 10000;

}  // namespace lamina::csg
