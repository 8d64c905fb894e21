#include "ros2/raw_type.hpp"

#include <cstring>

namespace stdc::ros2 {
namespace {

using eprosima::fastrtps::rtps::SerializedPayload_t;
using Sample = std::vector<std::uint8_t>;

constexpr std::uint32_t kFirstSize = 512;  // of a message's memory, which grows as needed

}  // namespace

RawType::RawType(const std::string& name) {
  setName(name.c_str());
  m_typeSize = kFirstSize;
  m_isGetKeyDefined = false;
  auto_fill_type_object(false);
  auto_fill_type_information(false);
}

bool RawType::serialize(void* data, SerializedPayload_t* payload) {
  const auto& bytes = *static_cast<const Sample*>(data);
  if (bytes.size() > payload->max_size) return false;
  std::memcpy(payload->data, bytes.data(), bytes.size());
  payload->length = static_cast<std::uint32_t>(bytes.size());
  payload->encapsulation = CDR_LE;
  return true;
}

bool RawType::deserialize(SerializedPayload_t* payload, void* data) {
  static_cast<Sample*>(data)->assign(payload->data, payload->data + payload->length);
  return true;
}

std::function<uint32_t()> RawType::getSerializedSizeProvider(void* data) {
  return [data] { return static_cast<std::uint32_t>(static_cast<const Sample*>(data)->size()); };
}

// Fast DDS asks for memory by these two, as its interface has it.
void* RawType::createData() { return std::make_unique<Sample>().release(); }
void RawType::deleteData(void* data) { const std::unique_ptr<Sample> owned(static_cast<Sample*>(data)); }

bool RawType::getKey(void* /*data*/, eprosima::fastrtps::rtps::InstanceHandle_t* /*handle*/,
                     bool /*force_md5*/) {
  return false;
}

}  // namespace stdc::ros2
