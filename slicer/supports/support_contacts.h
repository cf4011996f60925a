#pragma once
// Where supports touch the part, and how much of it.
//
// A layer of a design with supports knows the part and the supports by
// themselves. Where the part lies over a support of the layer below and not
// over itself, it touches that support: a piece of a **contact**. Pieces of
// neighbouring layers that touch make one contact. A support that stands on the
// part touches it in the same way from above. Areas are as seen from above.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/vec.h"
#include "slicer/check/thin/thin_finder.h"
#include "slicer/contour/layer.h"

namespace lamina::slicer {

struct SupportContact {
  Vec2 place = Vec2(0);        // its middle
  std::uint32_t layer = 0;     // of the part, from 1: the first that it touches
  double section_z = 0;        // of that layer
  double area = 0;             // as seen from above [mm²]
  bool is_from_above = false;  // the support stands on the part
  std::uint32_t instance = kNoInstance;  // of the part, where that is known
};

struct SupportMeasures {
  double volume = 0;  // of the supports outside the part [mm³]
  std::vector<SupportContact> contacts;  // from the bottom to the top

  double contact_area() const;  // of all [mm²]
};

// "174.2 mm³ of supports touch the part at 13 places, 0.918 mm² in all".
std::string size_text(const SupportMeasures& supports);

// What of a printed volume is not supports [mm³].
double part_volume(double printed,
                   const std::optional<SupportMeasures>& supports);

class SupportMeter {
 public:
  // Takes the next layer, from the bottom to the top.
  void take(const Layer& layer);

  SupportMeasures finish();

 private:
  // A contact that the next layer may add to.
  struct Growing {
    SupportContact contact;
    Box2 box;
    std::uint32_t last_layer = 0;
  };

  // A piece of a contact in one layer.
  struct Piece {
    Box2 box;
    double area = 0;
  };

  static std::vector<Piece> find_pieces(const Layer& part,
                                        const Layer& supports);
  void add(const std::vector<Piece>& pieces, const Layer& part,
           std::uint32_t number, bool is_from_above);

  Layer last_;
  std::uint32_t layers_ = 0;
  std::vector<Growing> growing_;
  SupportMeasures measures_;
};

}  // namespace lamina::slicer
