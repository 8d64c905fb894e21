#pragma once

#include <string>

#include "atlas/storage/map_file.hpp"
#include "atlas/test_scene.hpp"

/// Maps to bytes and back, for tests.
namespace stdc::test {

std::string bytes_of(const Camera& camera, const Atlas& atlas);

StoredMap map_of(const std::string& bytes);

void expect_same(const FrameFeatures& a, const FrameFeatures& b);

/// The maps hold the same; ids may differ.
void expect_same(const Atlas& a, const Atlas& b);

}  // namespace stdc::test
