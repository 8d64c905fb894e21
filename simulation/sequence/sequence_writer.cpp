#include "simulation/sequence/sequence_writer.hpp"

#include "core/error.hpp"

namespace stdc::simulation {

SequenceWriter::SequenceWriter(const std::filesystem::path& folder, const Camera& camera, int frame_count,
                               bool overwrite)
    : writer_({folder,
               {"rgb", "depth", "mask", "moved"},
               overwrite ? "rgb.txt" : "",
               "--output",
               overwrite ? "remove it yourself or choose another --output"
                         : "remove it, choose another --output or add --overwrite"}) {
  if (frame_count <= 0) throw Error("frames", "there is nothing to write", "ask for one frame or more");
  truth_.resize(static_cast<std::size_t>(frame_count));
  writer_.write_camera(camera);
}

void SequenceWriter::write(int index, const RenderedFrame& frame) {
  const double timestamp = frame.image.timestamp;
  writer_.write_image("rgb", timestamp, frame.image.colour);
  writer_.write_image("depth", timestamp, frame.image.depth);
  writer_.write_image("mask", timestamp, frame.mask);
  if (!frame.moved.empty()) writer_.write_image("moved", timestamp, frame.moved);
  truth_.at(static_cast<std::size_t>(index)) = {timestamp, frame.world_from_cam};
}

void SequenceWriter::finish() {
  writer_.write_text("groundtruth.txt",
                     "# ground truth: pose of the colour camera in the world\n"
                     "# timestamp tx ty tz qx qy qz qw\n" +
                         format_trajectory(truth_));
  writer_.commit();
}

}  // namespace stdc::simulation
