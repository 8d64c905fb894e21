// fuzz_seeds FOLDER: writes small valid images for the image fuzzers to start from.
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "core/image_codec.hpp"
#include "core/random.hpp"

namespace {

cv::Mat picture(int type) {
  stdc::Random random(1);
  cv::Mat image(24, 40, type);
  const std::size_t row_bytes = image.elemSize() * 40;
  for (int y = 0; y < image.rows; ++y) {
    for (std::size_t i = 0; i < row_bytes; ++i) {
      image.ptr(y)[i] =
          static_cast<std::uint8_t>(4 * static_cast<int>(i) + static_cast<int>(random.below(16)));
    }
  }
  return image;
}

void write(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: fuzz_seeds FOLDER\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder / "colour_image");
  std::filesystem::create_directories(folder / "depth_image");
  write(folder / "colour_image/colour.png", stdc::encode_png(picture(CV_8UC3)));
  write(folder / "colour_image/grey.png", stdc::encode_png(picture(CV_8UC1)));
  write(folder / "colour_image/colour.jpg", stdc::encode_jpeg(picture(CV_8UC3)));
  write(folder / "colour_image/grey.jpg", stdc::encode_jpeg(picture(CV_8UC1), 50));
  write(folder / "depth_image/depth.png", stdc::encode_png(picture(CV_16UC1)));
  return 0;
}
