#pragma once

#include <dds/dds.h>

#include <chrono>
#include <stdexcept>
#include <string>

namespace stdc::ros2_peer {

/// Throws if a call of Cyclone DDS failed.
inline dds_entity_t check(dds_return_t result, const char* what) {
  if (result < 0) throw std::runtime_error(std::string(what) + ": " + dds_strretcode(-result));
  return result;
}

/// Quality of service, as ROS 2 has it.
struct Service {
  bool reliable = true, transient_local = false;
  int depth = 10;  ///< 0: keep all, and wait for the reader
};

/// A participant with writers and readers of its own, all gone with it.
class Participant {
 public:
  explicit Participant(int domain)
      : entity_(check(dds_create_participant(static_cast<dds_domainid_t>(domain), nullptr, nullptr),
                      "participant")) {}
  ~Participant() { dds_delete(entity_); }
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  dds_entity_t writer(const dds_topic_descriptor_t& type, const std::string& topic, Service service) const {
    return make(type, topic, service, dds_create_writer);
  }
  dds_entity_t reader(const dds_topic_descriptor_t& type, const std::string& topic, Service service) const {
    return make(type, topic, service, dds_create_reader);
  }

 private:
  template <typename Create>
  dds_entity_t make(const dds_topic_descriptor_t& type, const std::string& topic, Service service,
                    Create create) const {
    dds_qos_t* qos = dds_create_qos();
    dds_qset_reliability(qos, service.reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                         DDS_SECS(60));
    dds_qset_durability(qos,
                        service.transient_local ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
    dds_qset_history(qos, service.depth > 0 ? DDS_HISTORY_KEEP_LAST : DDS_HISTORY_KEEP_ALL, service.depth);
    const dds_entity_t made_topic =
        check(dds_create_topic(entity_, &type, ("rt" + topic).c_str(), nullptr, nullptr), topic.c_str());
    const dds_entity_t made = check(create(entity_, made_topic, qos, nullptr), topic.c_str());
    dds_delete_qos(qos);
    return made;
  }

  dds_entity_t entity_;
};

using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace stdc::ros2_peer
