#include "segmentation/network/safetensors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

#include "core/error.hpp"
#include "core/files/test_folder.hpp"
#include "segmentation/network/kernels/weight_kernels.hpp"

namespace stdc {
namespace {

using test::message_of;
using test::TestFolder;

std::string file_of(const std::string& header, const std::string& data) {
  const std::uint64_t length = header.size();
  return std::string(reinterpret_cast<const char*>(&length), sizeof length) + header + data;
}

SafetensorsFile open(const std::string& bytes) {
  return {std::make_unique<std::istringstream>(bytes), bytes.size(), "file"};
}

std::string refusal(const std::string& bytes) {
  return message_of([&] { open(bytes); });
}

template <typename T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

std::string one_tensor(const std::string& type, const std::string& shape, int begin, int end) {
  return R"({"t":{"dtype":")" + type + R"(","shape":)" + shape + R"(,"data_offsets":[)" +
         std::to_string(begin) + "," + std::to_string(end) + "]}}";
}

void expect_refused(const std::string& bytes, const std::string& part) {
  const std::string message = refusal(bytes);
  EXPECT_NE(message.find(part), std::string::npos) << "'" << message << "' has no '" << part << "'";
  EXPECT_EQ(message.rfind("file", 0), 0U) << message;
  EXPECT_NE(message.find("; "), std::string::npos) << "no hint: " << message;
}

TEST(Safetensors, ReadsFloatsHalvesAndMetadata) {
  const std::string header =
      R"({"__metadata__":{"k":"v"},"h":{"dtype":"F16","shape":[3],"data_offsets":[8,14]},)"
      R"("f":{"dtype":"F32","shape":[1,2],"data_offsets":[0,8]},"e":{"dtype":"F32","shape":[0],"data_offsets":[14,14]}})";
  const auto file = open(file_of(header, bytes_of(std::vector<float>{1.5F, -2}) +
                                             bytes_of(std::vector<std::uint16_t>{0x3C00, 0xC100, 0x0001})));
  EXPECT_EQ(file.metadata().at("k"), "v");
  EXPECT_EQ(file.tensors().size(), 3U);
  EXPECT_EQ(file.tensors().at("f").shape, (std::vector<std::int64_t>{1, 2}));
  EXPECT_EQ(file.floats("f"), (std::vector<float>{1.5F, -2}));
  EXPECT_EQ(file.floats("h"), (std::vector<float>{1, -2.5F, 0x1p-24F}));
  EXPECT_TRUE(file.floats("e").empty());
  EXPECT_EQ(file.floats("f"), file.floats("f"));
}

TEST(Safetensors, HalvesAreExact) {
  EXPECT_EQ(float_from_half(0x7BFF), 65504);
  EXPECT_EQ(float_from_half(0x0400), 0x1p-14F);
  EXPECT_EQ(float_from_half(0x83FF), -1023 * 0x1p-24F);
  EXPECT_TRUE(std::signbit(float_from_half(0x8000)));
  EXPECT_TRUE(std::isinf(float_from_half(0xFC00)));
  EXPECT_TRUE(std::isnan(float_from_half(0x7E00)));
  float before = -1;
  for (std::uint16_t half = 0; half < 0x7C00; ++half) {
    const float value = float_from_half(half);
    EXPECT_GT(value, before);
    before = value;
  }
}

TEST(Safetensors, RefusesEveryTruncation) {
  const std::string bytes = file_of(one_tensor("F32", "[2]", 0, 8), std::string(8, '\1'));
  EXPECT_EQ(refusal(bytes), "");
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_NE(refusal(bytes.substr(0, length)), "") << length;
  }
  expect_refused("", "too short");
  expect_refused(bytes.substr(0, 20), "truncated");
  expect_refused(bytes.substr(0, bytes.size() - 1), "1 bytes of data are missing");
  expect_refused(bytes + "x", "1 bytes too many");
}

TEST(Safetensors, RefusesDamagedHeaders) {
  const std::string data(8, '\0');
  std::string bytes = file_of(one_tensor("F32", "[2]", 0, 8), data);
  bytes[7] = '\x7F';
  expect_refused(bytes, "header is too long");
  expect_refused(file_of("[]", data), "not a JSON object");
  expect_refused(file_of("{", data), "not a JSON object");
  expect_refused(file_of(std::string(100000, '['), data), "not that of a safetensors file");
  expect_refused(file_of(R"({"t":3})", data), "lacks dtype");
  expect_refused(file_of(R"({"__metadata__":{"k":3}})", ""), "not all texts");
  expect_refused(file_of(R"({"__metadata__":3})", ""), "not an object");
  expect_refused(file_of(one_tensor("F99", "[2]", 0, 8), data), "type is not known");
  expect_refused(file_of(one_tensor("F32", "[-2]", 0, 8), data), "shape is damaged");
  expect_refused(file_of(one_tensor("F32", "[2.5]", 0, 8), data), "shape is damaged");
  expect_refused(file_of(one_tensor("F32", "[4294967296,4294967296]", 0, 8), data), "shape is damaged");
  expect_refused(file_of(one_tensor("F32", "[1,1,1,1,1,1,1,1,2]", 0, 8), data), "lacks dtype");
  expect_refused(file_of(one_tensor("F32", "[2]", 8, 0), data), "place in the file is damaged");
  expect_refused(file_of(one_tensor("F32", "[3]", 0, 8), data), "takes 8 bytes, but its shape 12");
  expect_refused(file_of(one_tensor("F32", "[2]", 4, 12), data + data), "gap");
  const std::string entry = R"("t":{"dtype":"F32","shape":[1],"data_offsets":[0,4]})";
  expect_refused(file_of("{" + entry + "," + entry + "}", data), "'t' twice");
  expect_refused(file_of("{" + entry + R"(,"u":{"dtype":"F32","shape":[1],"data_offsets":[0,4]}})", data),
                 "overlaps");
}

TEST(Safetensors, RefusesWrongNumbers) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    const auto file = open(file_of(one_tensor("F32", "[2]", 0, 8), bytes_of(std::vector<float>{1, bad})));
    EXPECT_NE(message_of([&] { file.floats("t"); }).find("file: tensor 't': holds NaN or infinity"),
              std::string::npos);
  }
  const auto half =
      open(file_of(one_tensor("F16", "[1]", 0, 2), bytes_of(std::vector<std::uint16_t>{0x7C00})));
  EXPECT_THROW(half.floats("t"), Error);
  const auto whole = open(file_of(one_tensor("I64", "[1]", 0, 8), std::string(8, '\0')));
  EXPECT_NE(message_of([&] { whole.floats("t"); }).find("is of type I64"), std::string::npos);
  EXPECT_NE(message_of([&] { whole.floats("u"); }).find("has no tensor 'u'"), std::string::npos);
}

TEST(Safetensors, ReadsFromTheDisk) {
  const TestFolder folder;
  const auto path =
      folder.write("a.safetensors", file_of(one_tensor("F32", "[2]", 0, 8), std::string(8, '\0')));
  EXPECT_EQ(SafetensorsFile(path).floats("t"), (std::vector<float>{0, 0}));
  EXPECT_NE(message_of([&] { SafetensorsFile(folder / "none"); }).find("none: cannot be opened"),
            std::string::npos);
  EXPECT_NE(message_of([&] { SafetensorsFile(folder.path()); }).find("is a folder"), std::string::npos);
}

}  // namespace
}  // namespace stdc
