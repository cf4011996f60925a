#pragma once
// Draws loops point by point, without points that change nothing.
//
// The pen leaves out points that repeat their neighbour, points on the line
// between their neighbours, and tips of spikes without width. These are rare:
// a few products show that a point stays.

#include <cstddef>
#include <vector>

#include "base/vec.h"
#include "plane/contours.h"

namespace lamina::plane {

class LoopPen {
 public:
  // merge_distance  points nearer than this are one, and a point nearer than
  //                 this to the line through its neighbours is left out [mm]
  // least_area      loops with less are dropped [mm²]
  LoopPen(double merge_distance, double least_area)
      : merge_distance_(merge_distance),
        merge_squared_(merge_distance * merge_distance),
        least_area_(least_area) {}

  // Adds loops to `contours` from here on, which the pen alone may change until
  // lift().
  void begin(Contours& contours);
  void lift();

  // Goes on from `head` through the points [first, last), or from last back to
  // first, to `tail`.
  void draw_forward(const Vec2& head, const Vec2* first, const Vec2* last,
                    const Vec2& tail) {
    draw(head, first, last - first, 1, tail);
  }
  void draw_backward(const Vec2& head, const Vec2* first, const Vec2* last,
                     const Vec2& tail) {
    draw(head, last - 1, last - first, -1, tail);
  }

  // Ends the loop.
  void close_loop();

 private:
  void draw(const Vec2& head, const Vec2* from, std::ptrdiff_t count,
            std::ptrdiff_t stride, const Vec2& tail);
  Vec2* add(Vec2* end, const Vec2& point);
  Vec2* add_run(Vec2* end, const Vec2* from, std::ptrdiff_t count,
                std::ptrdiff_t stride);
  bool is_straight(const Vec2& in, const Vec2& out) const;
  bool are_near(const Vec2& a, const Vec2& b) const;
  bool is_redundant(const Vec2& before, const Vec2& point,
                    const Vec2& after) const;

  const double merge_distance_;
  const double merge_squared_;
  const double least_area_;
  Contours* contours_ = nullptr;
  std::size_t loop_begin_ = 0;  // in the points, which are kept longer
  std::size_t loop_end_ = 0;
  Vec2 last_step_ = Vec2(0);  // between the last two points; 0: there are none
};

}  // namespace lamina::plane
