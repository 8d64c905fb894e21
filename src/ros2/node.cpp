#include "ros2/node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <map>
#include <mutex>

#include "core/error.hpp"
#include "ros2/raw_type.hpp"
#include "ros2/topic_names.hpp"

namespace stdc::ros2 {
namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

constexpr const char* kNetworkHint = "check ROS_DOMAIN_ID, ROS_LOCALHOST_ONLY and the network";
/// Messages that a publisher has to keep while we are busy, and we while our own threads are.
constexpr int kMaxKept = 16;

/// Sets what readers and writers share.
template <typename Qos>
void set_delivery(const Delivery& delivery, Qos& qos) {
  qos.reliability().kind =
      delivery.reliable ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
  qos.durability().kind =
      delivery.transient_local ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  const bool keep_all = delivery.depth == 0;
  qos.history().kind = keep_all ? dds::KEEP_ALL_HISTORY_QOS : dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = keep_all ? kMaxKept : delivery.depth;
  qos.resource_limits().max_instances = 1;
  qos.resource_limits().max_samples = qos.history().depth;
  qos.resource_limits().max_samples_per_instance = qos.history().depth;
  qos.resource_limits().allocated_samples = 1;
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  // Versions of Fast DDS share memory in ways of their own.
  qos.data_sharing().off();
}

std::string policy_name(dds::QosPolicyId_t policy) {
  if (policy == dds::RELIABILITY_QOS_POLICY_ID) return "reliability";
  if (policy == dds::DURABILITY_QOS_POLICY_ID) return "durability";
  return fmt::format("policy {}", static_cast<int>(policy));
}

class FastSubscription : public Subscription, private dds::DataReaderListener {
 public:
  FastSubscription(dds::Subscriber& subscriber, dds::Topic& topic, const Delivery& delivery,
                   std::function<void()> on_message)
      : subscriber_(subscriber), on_message_(std::move(on_message)) {
    dds::DataReaderQos qos = subscriber.get_default_datareader_qos();
    set_delivery(delivery, qos);
    qos.reliable_reader_qos().times.heartbeatResponseDelay = {0, 0};  // who waits for us shall not wait longer
    reader_ = subscriber.create_datareader(&topic, qos, this, dds::StatusMask::all());
    if (reader_ == nullptr) throw Error(topic.get_name(), "cannot be subscribed to", kNetworkHint);
  }
  ~FastSubscription() override {
    reader_->set_listener(nullptr);
    subscriber_.delete_datareader(reader_);
  }

  std::optional<std::vector<std::uint8_t>> take() override {
    std::vector<std::uint8_t> bytes;
    dds::SampleInfo info;
    while (reader_->take_next_sample(&bytes, &info) == ReturnCode_t::RETCODE_OK) {
      if (info.valid_data) return bytes;  // else the publisher said that it goes
    }
    return std::nullopt;
  }
  int publishers() const override { return publishers_; }
  int lost() const override { return lost_; }
  std::string incompatibility() const override {
    const std::lock_guard lock(mutex_);
    return incompatibility_;
  }

 private:
  void on_data_available(dds::DataReader* /*reader*/) override {
    if (on_message_) on_message_();
  }
  void on_subscription_matched(dds::DataReader* /*reader*/,
                               const dds::SubscriptionMatchedStatus& status) override {
    publishers_ = status.current_count;
  }
  void on_sample_lost(dds::DataReader* /*reader*/, const dds::SampleLostStatus& status) override {
    lost_ = status.total_count;
  }
  void on_requested_incompatible_qos(dds::DataReader* /*reader*/,
                                     const dds::RequestedIncompatibleQosStatus& status) override {
    const std::lock_guard lock(mutex_);
    incompatibility_ = policy_name(status.last_policy_id);
  }

  dds::Subscriber& subscriber_;
  std::function<void()> on_message_;
  std::atomic<int> publishers_ = 0, lost_ = 0;
  mutable std::mutex mutex_;
  std::string incompatibility_;
  dds::DataReader* reader_ = nullptr;  ///< of the subscriber
};

class FastPublication : public Publication, private dds::DataWriterListener {
 public:
  FastPublication(dds::Publisher& publisher, dds::Topic& topic, const Delivery& delivery)
      : publisher_(publisher) {
    dds::DataWriterQos qos = publisher.get_default_datawriter_qos();
    set_delivery(delivery, qos);
    qos.publish_mode().kind =
        delivery.large ? dds::ASYNCHRONOUS_PUBLISH_MODE : dds::SYNCHRONOUS_PUBLISH_MODE;
    writer_ = publisher.create_datawriter(&topic, qos, this, dds::StatusMask::all());
    if (writer_ == nullptr) throw Error(topic.get_name(), "cannot be published", kNetworkHint);
  }
  ~FastPublication() override {
    writer_->set_listener(nullptr);
    publisher_.delete_datawriter(writer_);
  }

  bool publish(Bytes message) override {
    sample_.assign(message.begin(), message.end());
    return writer_->write(&sample_);
  }
  int subscribers() const override { return subscribers_; }

 private:
  void on_publication_matched(dds::DataWriter* /*writer*/,
                              const dds::PublicationMatchedStatus& status) override {
    subscribers_ = status.current_count;
  }

  dds::Publisher& publisher_;
  std::vector<std::uint8_t> sample_;
  std::atomic<int> subscribers_ = 0;
  dds::DataWriter* writer_ = nullptr;  ///< of the publisher
};

dds::DomainParticipantQos participant_qos(const NodeOptions& options) {
  constexpr std::uint32_t kBuffer = 8U << 20U;  // the system may give less (net.core.rmem_max)
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->receiveBufferSize = kBuffer;
  udp->sendBufferSize = kBuffer;
  dds::DomainParticipantQos qos;
  qos.name("stdc_slam");
  if (options.localhost_only) {
    constexpr std::uint32_t kLocalhost[] = {127, 0, 0, 1};
    udp->interfaceWhiteList = {"127.0.0.1"};
    // Where multicast does not pass over loopback, participants are looked for at their usual ports.
    rtps::Locator_t peer;
    peer.kind = LOCATOR_KIND_UDPv4;
    for (int i = 0; i < 4; ++i) peer.address[12 + i] = static_cast<rtps::octet>(kLocalhost[i]);
    qos.wire_protocol().builtin.initialPeersList.push_back(peer);
    rtps::Locator_t group = peer;
    const std::uint32_t multicast[] = {239, 255, 0, 1};
    for (int i = 0; i < 4; ++i) group.address[12 + i] = static_cast<rtps::octet>(multicast[i]);
    qos.wire_protocol().builtin.initialPeersList.push_back(group);
  }
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(udp);
  const std::string enclave = "enclave=/;";  // as ROS 2's nodes without security say
  qos.user_data().data_vec({enclave.begin(), enclave.end()});
  return qos;
}

}  // namespace

class Node::Participant : private dds::DomainParticipantListener {
 public:
  explicit Participant(const NodeOptions& options) {
    dds::Log::ClearConsumers();  // it would print
    participant_ = dds::DomainParticipantFactory::get_instance()->create_participant(
        static_cast<std::uint32_t>(options.domain), participant_qos(options), this, dds::StatusMask::none());
    if (participant_ != nullptr) {
      subscriber_ = participant_->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
      publisher_ = participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
    }
    if (subscriber_ == nullptr || publisher_ == nullptr) {
      throw Error(fmt::format("ROS 2 domain {}", options.domain), "cannot be joined", kNetworkHint);
    }
  }
  ~Participant() override {
    if (participant_ == nullptr) return;
    participant_->set_listener(nullptr);
    participant_->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  dds::Topic& topic(const std::string& name, const std::string& type) {
    const std::string wire_name = dds_topic(name), wire_type = dds_type(type);
    if (auto* known = participant_->lookup_topicdescription(wire_name); known != nullptr) {
      return dynamic_cast<dds::Topic&>(*known);
    }
    // The factory of types takes ownership.
    const dds::TypeSupport support(std::make_unique<RawType>(wire_type).release());
    support.register_type(participant_);
    dds::Topic* made = participant_->create_topic(wire_name, wire_type, dds::TOPIC_QOS_DEFAULT);
    if (made == nullptr) throw Error(name, "cannot be made a topic", kNetworkHint);
    return *made;
  }
  dds::Subscriber& subscriber() { return *subscriber_; }
  dds::Publisher& publisher() { return *publisher_; }

  std::vector<PublishedTopic> published() const {
    const std::lock_guard lock(mutex_);
    std::map<std::pair<std::string, std::string>, int> counts;
    for (const auto& [writer, topic] : writers_) ++counts[topic];
    std::vector<PublishedTopic> topics;
    for (const auto& [topic, count] : counts) topics.push_back({topic.first, topic.second, count});
    return topics;
  }

 private:
  void on_publisher_discovery(dds::DomainParticipant* /*participant*/,
                              rtps::WriterDiscoveryInfo&& info) override {
    const std::lock_guard lock(mutex_);
    if (info.status == rtps::WriterDiscoveryInfo::REMOVED_WRITER) {
      writers_.erase(info.info.guid());
      return;
    }
    const auto name = ros_topic(info.info.topicName().to_string());
    if (name) writers_[info.info.guid()] = {*name, ros_type(info.info.typeName().to_string())};
  }

  mutable std::mutex mutex_;
  std::map<rtps::GUID_t, std::pair<std::string, std::string>> writers_;  ///< topic and type of each
  dds::DomainParticipant* participant_ = nullptr;  ///< of the factory; what follows is of the participant
  dds::Subscriber* subscriber_ = nullptr;
  dds::Publisher* publisher_ = nullptr;
};

Node::Node(const NodeOptions& options)
    : options_(options), participant_(std::make_unique<Participant>(options)) {}
Node::~Node() = default;

std::unique_ptr<Subscription> Node::subscribe(const std::string& topic, const std::string& type,
                                              const Delivery& delivery, std::function<void()> on_message) {
  return std::make_unique<FastSubscription>(participant_->subscriber(), participant_->topic(topic, type),
                                            delivery, std::move(on_message));
}

std::unique_ptr<Publication> Node::advertise(const std::string& topic, const std::string& type,
                                             const Delivery& delivery) {
  return std::make_unique<FastPublication>(participant_->publisher(), participant_->topic(topic, type),
                                           delivery);
}

std::vector<PublishedTopic> Node::published() const { return participant_->published(); }

}  // namespace stdc::ros2
