#include "run/live_slam.hpp"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/files/unique_folder.hpp"

namespace stdc::app {
namespace {

namespace fs = std::filesystem;

/// A folder that goes with this.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::error_code failed;
    const fs::path parent = fs::temp_directory_path(failed);
    if (!failed) path_ = make_unique_folder(parent / "stdc-slam", failed);
    if (failed) throw Error("TMPDIR", "no file can be made there", "free space there, or set TMPDIR");
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

LiveSlam::LiveSlam(const Camera& camera, const Settings& settings, MakeSegmenter make_segmenter,
                   const std::optional<fs::path>& load_map)
    : camera_(camera), settings_(settings), make_segmenter_(std::move(make_segmenter)) {
  begin(load_map);
}

void LiveSlam::begin(const std::optional<fs::path>& map) {
  auto next = std::make_unique<Slam>(camera_, settings_, make_segmenter_());
  if (map) next->load_map(*map);
  slam_ = std::move(next);
}

void LiveSlam::reset() {
  settings_.system.localisation_only = false;
  begin(std::nullopt);
}

void LiveSlam::set_localisation_only(bool only) {
  if (only == localisation_only()) return;
  const TemporaryFolder folder;
  const fs::path map = folder.path() / "map";
  slam_->save_map(map);
  settings_.system.localisation_only = only;
  begin(map);
}

}  // namespace stdc::app
