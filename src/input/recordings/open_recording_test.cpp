#include "input/recordings/open_recording.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <numeric>

#include "core/files/test_folder.hpp"
#include "input/recordings/messages/message_image.hpp"
#include "input/recordings/messages/test_pattern.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using test::TestFolder;

struct Case {
  const char* name;
  const char* format;
  const char* style;
  bool indexed = true;
};

const std::vector<Case> kCases{{"raw.bz2.bag", "bag", "raw"},
                               {"png.lz4.bag", "bag", "png"},
                               {"raw.zstd.mcap", "mcap", "raw"},
                               {"png.lz4.mcap", "mcap", "png"},
                               {"raw.no-index.mcap", "mcap", "raw", false},
                               {"jpeg-inverse.zstd.mcap", "mcap", "jpeg-inverse"},
                               {"bgr-float.lz4.mcap", "mcap", "bgr-float"},
                               {"raw_db3_file", "db3", "raw"},
                               {"raw_mcap_split", "mcap", "raw"}};

std::vector<int> all_topics(const Recording& recording) {
  std::vector<int> topics(recording.topics().size());
  std::iota(topics.begin(), topics.end(), 0);
  return topics;
}

struct Counted {
  int colour = 0, depth = 0, other = 0;
  bool in_order = true;
  int total() const { return colour + depth + other; }
};

/// Checks each picture against the pattern, and counts.
Counted check_all(Recording& recording) {
  Counted counted;
  LogTime last = Recording::kBegin;
  while (const auto message = recording.next()) {
    const RecordedTopic& topic = recording.topics()[static_cast<std::size_t>(message->topic)];
    counted.in_order = counted.in_order && message->log_time >= last;
    last = message->log_time;
    const bool depth = topic.name.find("depth") != std::string::npos;
    DecodedImage decoded;
    if (topic.type == "sensor_msgs/Image") {
      const auto image = read_image_message(topic.serialisation, message->data);
      if (image) decoded = depth ? depth_of(*image) : colour_of(*image, ColourMode::as_stored);
    } else if (topic.type == "sensor_msgs/CompressedImage") {
      const auto image = read_compressed_image_message(topic.serialisation, message->data);
      if (image) decoded = depth ? depth_of(*image) : colour_of(*image, ColourMode::as_stored);
    } else {
      ++counted.other;
      continue;
    }
    EXPECT_EQ(decoded.problem, "");
    const int frame = depth ? counted.depth++ : counted.colour++;
    cv::Mat expected = depth ? test::pattern_depth(frame) : test::pattern_colour(frame);
    double tolerance = 0;
    if (decoded.image.type() == CV_32FC1) {
      expected.convertTo(expected, CV_32F, 1e-3);
      cv::patchNaNs(decoded.image, 0);
      tolerance = recording.where().find("inverse") != std::string::npos ? 1e-3 : 1e-6;
    } else if (!depth && recording.where().find("jpeg") != std::string::npos) {
      tolerance = 60;
    }
    EXPECT_EQ(decoded.image.type(), expected.type());
    if (decoded.image.type() == expected.type()) {
      EXPECT_LE(cv::norm(decoded.image, expected, cv::NORM_INF), tolerance) << topic.name << " " << frame;
    }
  }
  return counted;
}

TEST(OpenRecording, ReadsWhatOtherPeoplesWritersWrote) {
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.name);
    ASSERT_EQ(recording_format(test::pattern_recording(c.name)), c.format);
    const auto recording = open_recording(test::pattern_recording(c.name));
    EXPECT_EQ(recording->format(), c.format);
    ASSERT_EQ(recording->topics().size(), 5U);
    const bool packed = std::string(c.style) == "png" || std::string(c.style) == "jpeg-inverse";
    const std::string depth = "/camera/aligned_depth_to_color/image_raw";
    EXPECT_EQ(recording->topics()[0].name, packed ? depth + "/compressedDepth" : depth);
    EXPECT_EQ(recording->topics()[1].name, "/camera/color/camera_info");
    EXPECT_EQ(recording->topics()[1].type, "sensor_msgs/CameraInfo");
    EXPECT_EQ(recording->topics()[3].type, "geometry_msgs/PoseStamped");
    EXPECT_EQ(recording->topics()[4].type, "tf2_msgs/TFMessage");
    EXPECT_EQ(recording->topics()[0].count.value_or(0), c.indexed ? 4U : 0U);
    EXPECT_EQ(recording->first_time(), test::kPatternStart - 10'000'000);
    EXPECT_EQ(recording->last_time(), test::pattern_time(3) + 3'000'000);
    EXPECT_TRUE(recording->faults().empty());  // also without an index, if it ends as it should
    for (int run = 0; run < 2; ++run) {        // it can begin anew
      recording->start(all_topics(*recording));
      const Counted counted = check_all(*recording);
      EXPECT_TRUE(counted.in_order);
      EXPECT_EQ(counted.colour, 4);
      EXPECT_EQ(counted.depth, 4);
      EXPECT_EQ(counted.other, 1 + 4 + 4);
    }
  }
}

TEST(OpenRecording, GivesOnlyTheChosenTopicsFromATimeOn) {
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.name);
    const auto recording = open_recording(test::pattern_recording(c.name));
    const std::vector<int> info{recording->find_topic("/camera/color/camera_info").value()};
    recording->start(info, test::pattern_time(2));
    int count = 0;
    while (const auto message = recording->next()) {
      EXPECT_EQ(message->topic, info[0]);
      EXPECT_EQ(message->log_time, test::pattern_time(2 + count++));
    }
    EXPECT_EQ(count, 2);
  }
}

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Messages that can be read of a recording, or -1 if it is refused.
int readable(const fs::path& path, std::vector<std::string>& faults) {
  faults.clear();
  try {
    const auto recording = open_recording(path);
    recording->start(all_topics(*recording));
    int count = 0;
    while (recording->next()) ++count;
    faults = recording->faults();
    return count;
  } catch (const Error&) {
    return -1;
  }
}

TEST(OpenRecording, ReadsWhatIsLeftOfAFileThatWasCutOff) {
  for (const char* name :
       {"raw.bz2.bag", "png.lz4.bag", "raw.zstd.mcap", "png.lz4.mcap", "raw.no-index.mcap"}) {
    SCOPED_TRACE(name);
    const TestFolder folder;
    const std::string whole = bytes_of(test::pattern_recording(name));
    int last = -1;
    bool said = true;
    for (std::size_t size = whole.size() / 8; size < whole.size(); size += whole.size() / 8) {
      std::vector<std::string> faults;
      const int count = readable(folder.write("cut.rec", whole.substr(0, size)), faults);
      EXPECT_GE(count, last) << size;
      said = said && (count < 0 || !faults.empty());
      last = count;
    }
    EXPECT_TRUE(said);
    EXPECT_EQ(last, 17);  // only the index is cut
  }
}

TEST(OpenRecording, LeavesOutADamagedChunkAndSaysSo) {
  for (const char* name : {"raw.zstd.mcap", "png.lz4.mcap", "raw.bz2.bag"}) {
    SCOPED_TRACE(name);
    const TestFolder folder;
    std::string bytes = bytes_of(test::pattern_recording(name));
    // In the middle of what the first chunk holds.
    const std::size_t at = name[0] == 'r' && std::string(name).ends_with(".bag") ? 4096 + 600 : 400;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x55);
    std::vector<std::string> faults;
    const int count = readable(folder.write("damaged.rec", bytes), faults);
    EXPECT_LT(count, 17);
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_NE(faults[0].find("damaged.rec: the chunk at byte "), std::string::npos) << faults[0];
    EXPECT_NE(faults[0].find("is left out: "), std::string::npos) << faults[0];
  }
}

TEST(OpenRecording, AFolderWithoutMetadataIsReadByTheNumbersOfItsFiles) {
  const TestFolder folder;
  const std::string name = "x/raw_mcap_split_";
  folder.write(name + "9.mcap", bytes_of(test::pattern_recording("raw_mcap_split/raw_mcap_split_0.mcap")));
  folder.write(name + "10.mcap", bytes_of(test::pattern_recording("raw_mcap_split/raw_mcap_split_1.mcap")));
  ASSERT_EQ(recording_format(folder / "x"), "mcap");
  const auto recording = open_recording(folder / "x");
  recording->start(all_topics(*recording));
  const Counted counted = check_all(*recording);
  EXPECT_EQ(counted.total(), 17);
  EXPECT_TRUE(counted.in_order);
  ASSERT_EQ(recording->faults().size(), 1U);
  EXPECT_NE(recording->faults()[0].find("there is no metadata.yaml"), std::string::npos);
}

TEST(OpenRecording, RefusesWhatIsNone) {
  const TestFolder folder;
  EXPECT_EQ(recording_format(folder / "none.bag"), "");
  EXPECT_EQ(recording_format(folder.path()), "");
  EXPECT_NE(message_of([&] { open_recording(folder / "none.bag"); }).find("none.bag: cannot be opened"),
            std::string::npos);
  EXPECT_NE(message_of([&] { open_recording(folder.write("empty.bag", std::string())); }).find("is empty"),
            std::string::npos);
  EXPECT_NE(message_of([&] {
              open_recording(folder.write("old.bag", std::string("#ROSBAG V1.2\n")));
            }).find("version before 2.0"),
            std::string::npos);
  EXPECT_NE(message_of([&] {
              open_recording(folder.write("text.mcap", std::string("hello")));
            }).find("is no recording of a kind"),
            std::string::npos);
  EXPECT_NE(message_of([&] {
              open_recording(folder.write("x.mcap", std::string("\x89MCAP0\r\n")));
            }).find("holds no message"),
            std::string::npos);
  EXPECT_NE(message_of([&] {
              open_recording(folder.write("x.db3", std::string("SQLite format 3 and more")));
            }).find("is no recording of rosbag2"),
            std::string::npos);
  folder.write("r/metadata.yaml",
               std::string("rosbag2_bagfile_information:\n  relative_file_paths: [../x.mcap]\n"));
  EXPECT_NE(message_of([&] { open_recording(folder / "r/metadata.yaml"); }).find("outside its folder"),
            std::string::npos);
}

}  // namespace
}  // namespace stdc
