#include <fmt/format.h>

#include <cstdio>
#include <thread>

#include "commands.hpp"
#include "messages.h"
#include "peer.hpp"

namespace stdc::ros2_peer {
namespace {

void wait_for_reader(dds_entity_t writer) {
  const Clock::time_point start = Clock::now();
  dds_publication_matched_status_t status;
  while (seconds_since(start) < 20) {
    if (dds_get_publication_matched_status(writer, &status) == DDS_RETCODE_OK && status.current_count > 0)
      return;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

/// An image whose fields promise more bytes than it has, or the other way round, at some rate.
void send_images(dds_entity_t writer, int count, double rate, bool truncated, std::uint32_t width,
                 std::uint32_t height) {
  std::vector<std::uint8_t> pixels(truncated ? 100 : std::size_t{3} * width * height, 77);
  std::string frame = "camera_color_optical_frame", encoding = "rgb8";
  const Clock::time_point start = Clock::now();
  for (int i = 0; i < count; ++i) {
    sensor_msgs_msg_dds__Image_ message = {};
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    const auto ns = std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
    message.header_.stamp_ = {static_cast<std::int32_t>(ns / 1'000'000'000),
                              static_cast<std::uint32_t>(ns % 1'000'000'000)};
    message.header_.frame_id_ = frame.data();
    message.height_ = height, message.width_ = width;
    message.encoding_ = encoding.data();
    message.step_ = 3 * width;
    const auto size = static_cast<std::uint32_t>(pixels.size());
    message.data_ = {size, size, pixels.data(), false};
    check(dds_write(writer, &message), "image");
    std::this_thread::sleep_until(
        start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>((i + 1) / rate)));
  }
}

/// Messages of a type that says it is an image, and is something much shorter.
void send_lies(const Participant& participant, const std::string& topic, int count) {
  dds_topic_descriptor_t lying = std_msgs_msg_dds__Empty__desc;
  lying.m_typename = sensor_msgs_msg_dds__Image__desc.m_typename;
  const dds_entity_t writer = participant.writer(lying, topic, {});
  wait_for_reader(writer);
  for (int i = 0; i < count; ++i) {
    const std_msgs_msg_dds__Empty_ message = {1};
    check(dds_write(writer, &message), "lie");
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  std::this_thread::sleep_for(std::chrono::seconds(1));
}

}  // namespace

int evil(const std::vector<std::string>& words) {
  const Participant participant(domain());
  const std::string &topic = words[1], &kind = words[2];
  const int count = std::stoi(value_of(words, "--count", "100"));
  if (kind == "wrong-type") {
    participant.writer(std_msgs_msg_dds__Empty__desc, topic, {});
    std::this_thread::sleep_for(std::chrono::duration<double>(std::stod(value_of(words, "--seconds", "3"))));
    return 0;
  }
  if (kind == "lying-type") {
    send_lies(participant, topic, count);
    return 0;
  }
  const dds_entity_t writer = participant.writer(sensor_msgs_msg_dds__Image__desc, topic, {true, false, 5});
  wait_for_reader(writer);
  send_images(writer, count, std::stod(value_of(words, "--rate", "500")), kind == "truncated",
              static_cast<std::uint32_t>(std::stoul(value_of(words, "--width", "640"))),
              static_cast<std::uint32_t>(std::stoul(value_of(words, "--height", "480"))));
  std::this_thread::sleep_for(std::chrono::seconds(1));
  return 0;
}

int send_empty(const std::vector<std::string>& words) {
  const Participant participant(domain());
  const dds_entity_t writer = participant.writer(std_msgs_msg_dds__Empty__desc, words[1], {true, false, 1});
  wait_for_reader(writer);
  const std_msgs_msg_dds__Empty_ message = {};
  check(dds_write(writer, &message), "message");
  std::this_thread::sleep_for(std::chrono::milliseconds(300));  // until it is acknowledged
  return 0;
}

}  // namespace stdc::ros2_peer
