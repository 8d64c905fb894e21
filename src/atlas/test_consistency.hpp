#pragma once

#include "atlas/atlas.hpp"

/// What holds of every atlas, for tests.
namespace stdc::test {

/// Each map is a tree of its own whose root is its oldest keyframe; nothing leads from one to another.
void expect_separate_maps(const Atlas& atlas);

/// Both sides of every observation agree, and all that is named exists.
void expect_consistent(const Atlas& atlas);

}  // namespace stdc::test
