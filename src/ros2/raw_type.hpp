#pragma once

#include <cstdint>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <string>
#include <vector>

namespace stdc::ros2 {

/// Tells Fast DDS to hand messages over as the bytes that they are, whatever their type: they are read and
/// written elsewhere. A sample is a std::vector<std::uint8_t>.
class RawType : public eprosima::fastdds::dds::TopicDataType {
 public:
  /// @param name  as on the wire
  explicit RawType(const std::string& name);

  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override;
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override;
  std::function<uint32_t()> getSerializedSizeProvider(void* data) override;
  void* createData() override;
  void deleteData(void* data) override;
  bool getKey(void* data, eprosima::fastrtps::rtps::InstanceHandle_t* handle, bool force_md5) override;
};

}  // namespace stdc::ros2
