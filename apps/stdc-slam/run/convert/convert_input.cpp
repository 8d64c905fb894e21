#include "run/convert/convert_input.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "input/depth_units.hpp"
#include "input/layouts/tum_writer.hpp"
#include "run/inpaint/inpainted_folder.hpp"
#include "run/progress.hpp"
#include "run/track_frames.hpp"

namespace stdc::app {
namespace {

namespace fs = std::filesystem;

TumTarget target(const SequenceInput& input, const fs::path& folder, bool overwrite) {
  std::error_code problem;
  if (fs::equivalent(folder, input.source().where(), problem)) {
    throw Error(folder.string(), "is the input itself", "give another --output folder");
  }
  TumTarget target;
  target.folder = folder;
  if (overwrite) target.replaceable = "rgb.txt";
  target.hint = "choose another --output, or give --overwrite if it is a sequence";
  return target;
}

/// As it is stored, if it is a file: a JPEG decoded to grey is not the same as decoded to colour and made
/// grey.
void write_colour(const LoadedFrame& frame, TumWriter& writer) {
  const auto file = frame.packed->colour_file();
  if (file && (is_png(*file) || is_jpeg(*file))) {
    writer.write_image_file("rgb", frame.timestamp, is_png(*file) ? "png" : "jpg", *file);
  } else {
    writer.write_image("rgb", frame.timestamp, frame.image->colour);
  }
}

std::string format_imu(const std::vector<ImuSample>& samples) {
  std::string text;
  for (const ImuSample& s : samples) {
    text += fmt::format("{:.6f} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g}\n", s.timestamp, s.gyroscope.x(),
                        s.gyroscope.y(), s.gyroscope.z(), s.acceleration.x(), s.acceleration.y(),
                        s.acceleration.z());
  }
  return text;
}

}  // namespace

ConvertReport convert_frames(const SequenceInput& input, bool quiet, const InterruptWatch& interrupts,
                             const std::function<void(const LoadedFrame&, ConvertReport&)>& write) {
  FrameLoader loader(input, ColourMode::as_stored);
  Progress progress(input.source().is_live() ? "recording" : "converting", "frames",
                    input.expected_frame_count(), quiet);
  ConvertReport report;
  while (const auto frame = next_frame(input, loader, interrupts)) {
    if (frame->error) {
      if (frame->index == 0) throw *frame->error;  // then the camera or the whole input is wrong
      ++report.unreadable;
      progress.message(fmt::format("stdc-slam: {}; frame {} is left out", frame->error->what(),
                                   input.first_frame() + frame->index));
      continue;
    }
    write(*frame, report);
    report.imu_readings += static_cast<int>(frame->imu.size());
    progress.update(++report.frames);
    if (!input.source().is_live() && interrupts.interrupted())
      throw Error("interrupted", "nothing was written", "start again, perhaps with --frames");
  }
  progress.finish();
  for (const std::string& fault : input.source().faults()) progress.message("stdc-slam: " + fault);
  if (report.frames == 0)
    throw Error(input.source().where(), "holds no frame", "stdc-slam info shows what is in it");
  return report;
}

ConvertReport convert_input(const SequenceInput& input, const fs::path& folder, bool overwrite, bool quiet,
                            const InterruptWatch& interrupts) {
  TumWriter writer(target(input, folder, overwrite));
  std::string imu;
  const auto write = [&](const LoadedFrame& frame, ConvertReport& report) {
    write_colour(frame, writer);
    writer.write_image(
        "depth", frame.depth_timestamp,
        depth_in_units(frame.image->depth, input.camera.depth_units_per_metre, report.too_far));
    imu += format_imu(frame.imu);
  };
  const ConvertReport report = convert_frames(input, quiet, interrupts, write);
  writer.write_camera(input.camera);
  write_truth(input, writer);
  if (!imu.empty()) writer.write_text("imu.txt", "# timestamp wx wy wz ax ay az\n" + imu);
  writer.commit();
  return report;
}

}  // namespace stdc::app
