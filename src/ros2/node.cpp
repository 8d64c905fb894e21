#include "ros2/node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <map>
#include <mutex>

#include "core/error.hpp"
#include "ros2/fast_endpoints.hpp"
#include "ros2/network.hpp"
#include "ros2/raw_type.hpp"
#include "ros2/reliable_subscription.hpp"
#include "ros2/topic_names.hpp"

namespace stdc::ros2 {
namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

dds::DomainParticipantQos participant_qos(const NodeOptions& options) {
  const Network network = make_network(options);
  dds::DomainParticipantQos qos;
  qos.name("stdc_slam");
  for (const rtps::Locator_t& peer : network.initial_peers) {
    qos.wire_protocol().builtin.initialPeersList.push_back(peer);
  }
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(network.transport);
  qos.user_data().data_vec({network.user_data.begin(), network.user_data.end()});
  return qos;
}

}  // namespace

class Node::Participant : private dds::DomainParticipantListener {
 public:
  explicit Participant(const NodeOptions& options) : options_(options) {
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
  ReliableParticipant& reliable() {
    if (!reliable_) reliable_ = std::make_unique<ReliableParticipant>(options_);
    return *reliable_;
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

  NodeOptions options_;
  std::unique_ptr<ReliableParticipant> reliable_;  ///< made when something large is to be received reliably
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
  if (delivery.reliable && (delivery.large || delivery.depth == 0)) {
    return participant_->reliable().subscribe(dds_topic(topic), dds_type(type), delivery,
                                              std::move(on_message));
  }
  return make_subscription(participant_->subscriber(), participant_->topic(topic, type), delivery,
                           std::move(on_message));
}

std::unique_ptr<Publication> Node::advertise(const std::string& topic, const std::string& type,
                                             const Delivery& delivery) {
  return make_publication(participant_->publisher(), participant_->topic(topic, type), delivery);
}

std::vector<PublishedTopic> Node::published() const { return participant_->published(); }

}  // namespace stdc::ros2
