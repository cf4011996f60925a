#pragma once
// How many crossings a layer has, from a sample of its pairs of chains.

#include "plane/chains.h"

namespace lamina::plane {

// The crossings of a layer's chains for each chain, estimated in O(n log n):
// of n pairs drawn at random, but the same ones at each call, those count that
// have changed their order, by more than a tie, between where both have begun
// and where one ends. So pairs that cross an even number of times are missed.
double sample_crossings_per_chain(const LayerChains& layer,
                                  double tie_distance);

}  // namespace lamina::plane
