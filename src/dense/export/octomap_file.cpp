#include "dense/export/octomap_file.hpp"

#include "core/error.hpp"

#ifdef STDC_WITH_OCTOMAP
#include <octomap/OcTree.h>

#include <cmath>
#endif

namespace stdc {

#ifdef STDC_WITH_OCTOMAP

bool has_octomap() { return true; }

void write_octomap(std::ostream& stream, const OccupancyCells& cells) {
  constexpr int kMiddle = 1 << 15;  // keys have 16 bits
  for (int k = 0; k < 3; ++k) {
    if (cells.first[k] >= -kMiddle && cells.first[k] + cells.count[k] <= kMiddle) continue;
    throw Error("--octomap", "the map is too large for an octree of such cells",
                "choose a larger dense.cell");
  }
  // A float's decimals would show in the file.
  octomap::OcTree tree(std::round(static_cast<double>(cells.cell) * 1e6) * 1e-6);
  const float occupied = tree.getClampingThresMaxLog(), free = tree.getClampingThresMinLog();
  constexpr bool kLazy = true;
  for (int z = 0; z < cells.count[2]; ++z) {
    for (int y = 0; y < cells.count[1]; ++y) {
      for (int x = 0; x < cells.count[0]; ++x) {
        const Occupancy state = cells.at(x, y, z);
        if (state == Occupancy::unknown) continue;
        const octomap::OcTreeKey key(static_cast<octomap::key_type>(cells.first[0] + x + kMiddle),
                                     static_cast<octomap::key_type>(cells.first[1] + y + kMiddle),
                                     static_cast<octomap::key_type>(cells.first[2] + z + kMiddle));
        tree.setNodeValue(key, state == Occupancy::occupied ? occupied : free, kLazy);
      }
    }
  }
  tree.updateInnerOccupancy();
  tree.prune();
  tree.writeBinary(stream);
}

#else

bool has_octomap() { return false; }

void write_octomap(std::ostream& /*stream*/, const OccupancyCells& /*cells*/) {
  throw Error("--octomap", "this program was built without OctoMap",
              "install liboctomap-dev and build again, or choose another format");
}

#endif

}  // namespace stdc
