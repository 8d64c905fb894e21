#include "input/recordings/messages/message_reader.hpp"

#include <fastcdr/Cdr.h>
#include <fastcdr/exceptions/Exception.h>

#include <cstring>

namespace stdc {
namespace {

namespace fastcdr = eprosima::fastcdr;

/// Kind of encoding (big or little-endian XCDR1) and options, in front of each message.
constexpr std::size_t kEncapsulation = 4;

}  // namespace

MessageReader::MessageReader(Serialisation serialisation, Bytes data) : data_(data) {
  if (serialisation == Serialisation::ros1) return;
  ok_ = serialisation == Serialisation::cdr && data.size() >= kEncapsulation && data[0] == 0 && data[1] <= 1;
  // Fast CDR writes through the same pointer type; here it only reads.
  auto* bytes = const_cast<char*>(reinterpret_cast<const char*>(data.data()));
  buffer_ = std::make_unique<fastcdr::FastBuffer>(bytes, data.size());
  cdr_ = std::make_unique<fastcdr::Cdr>(*buffer_, fastcdr::Cdr::DEFAULT_ENDIAN, fastcdr::Cdr::DDS_CDR);
  if (ok_) cdr_->read_encapsulation();
}

MessageReader::~MessageReader() = default;

std::size_t MessageReader::left() const {
  return data_.size() - (cdr_ ? cdr_->getSerializedDataLength() : position_);
}

template <typename T>
T MessageReader::number() {
  T value{};
  if (!ok_) return value;
  if (cdr_) {
    try {
      cdr_->deserialize(value);
    } catch (const fastcdr::exception::Exception&) {
      ok_ = false;
      return T{};
    }
  } else if (const Bytes raw = take(sizeof(T)); raw.size() == sizeof(T)) {
    std::memcpy(&value, raw.data(), sizeof(T));
  }
  return value;
}

Bytes MessageReader::take(std::uint64_t size) {
  if (!ok_ || size > left()) {
    ok_ = false;
    return {};
  }
  const auto count = static_cast<std::size_t>(size);
  if (!cdr_) {
    position_ += count;
    return data_.subspan(position_ - count, count);
  }
  const auto* at = reinterpret_cast<const std::uint8_t*>(cdr_->getCurrentPosition());
  if (count == 0) return {};
  // A jump leaves Fast CDR with the size of what it read last, by which it aligns what comes next; reading
  // the last byte tells it that bytes were read.
  if (!cdr_->jump(count - 1)) ok_ = false;
  u8();
  return ok_ ? Bytes(at, count) : Bytes();
}

std::uint8_t MessageReader::u8() { return number<std::uint8_t>(); }
std::uint32_t MessageReader::u32() { return number<std::uint32_t>(); }
double MessageReader::f32() { return number<float>(); }
double MessageReader::f64() { return number<double>(); }

std::string_view MessageReader::text() {
  const Bytes raw = bytes();
  std::string_view result(reinterpret_cast<const char*>(raw.data()), raw.size());
  if (cdr_ && result.ends_with('\0')) result.remove_suffix(1);
  return result;
}

Bytes MessageReader::bytes() { return take(u32()); }

std::uint32_t MessageReader::length(std::size_t element) {
  const std::uint32_t count = u32();
  if (std::uint64_t{count} * element > left()) ok_ = false;
  return ok_ ? count : 0;
}

void MessageReader::f64s(std::span<double> values) {
  for (double& value : values) value = f64();
}

}  // namespace stdc
