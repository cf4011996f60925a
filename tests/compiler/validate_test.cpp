// What a request may ask for. tests/api/limits_test.cpp holds the program and
// the C++ interface to the same.

#include "compiler/validate.h"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace lamina::compiler {
namespace {

// What validate() throws; empty: nothing.
std::string fault_of(const Request& request) {
  try {
    validate(request);
  } catch (const RequestError& error) {
    return error.what();
  }
  return "";
}

TEST(Validate, LetsTheUsualRequestPass) { EXPECT_EQ(fault_of(Request()), ""); }

TEST(Validate, NumbersAreFinite) {
  for (const double value : {NAN, INFINITY, -INFINITY}) {
    Request layer;
    layer.job.layer_thickness = value;
    EXPECT_NE(fault_of(layer), "") << value;
    Request compensation;
    compensation.compensation.contour = value;
    EXPECT_NE(fault_of(compensation), "") << value;
    Request heights;
    heights.job.heights = {value};
    EXPECT_NE(fault_of(heights), "") << value;
  }
}

TEST(Validate, SaysWhatIsWrong) {
  Request layer;
  layer.job.layer_thickness = -0.5;
  EXPECT_EQ(fault_of(layer), "--layer: must be more than 0 mm, not -0.5");
  Request scale;
  scale.geometry.scale.y = 2000;
  EXPECT_EQ(fault_of(scale), "--scale: must be from 0.001 to 1000, not 2000");
  Request axis;
  axis.geometry.axis = "up";
  EXPECT_EQ(fault_of(axis),
            "--axis: 'up' is not one of z, x, y, -x, -y, -z, auto");
  Request heights;
  heights.job.heights = {1, 1};
  EXPECT_EQ(fault_of(heights), "--heights: heights must rise");
}

TEST(Validate, LimitsBelongToWhatIsAllowed) {
  Request request;
  request.geometry.scale = Vec3(0.001);
  request.compensation.contour = -100;
  request.job.tolerance = 0;
  request.job.threads = 1024;
  request.job.layer_thickness = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(fault_of(request), "");
}

TEST(Validate, RefusesWhatTheFormatCannotHold) {
  using enum slicer::OutputFormat;
  Request heights;
  heights.job.heights = {1, 2};
  for (const slicer::OutputFormat format : {kSl1, kNanoDlp, kThreemf}) {
    heights.output.format = format;
    EXPECT_NE(fault_of(heights), "");
  }
  heights.output.format = kSlc;
  EXPECT_EQ(fault_of(heights), "");
  Request mirror;
  mirror.output.mirrors_x = true;
  EXPECT_NE(fault_of(mirror), "");
  mirror.output.format = kPng;
  EXPECT_EQ(fault_of(mirror), "");
}

}  // namespace
}  // namespace lamina::compiler
