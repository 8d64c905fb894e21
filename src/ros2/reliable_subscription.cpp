#include "ros2/reliable_subscription.hpp"

#include <fastdds/rtps/RTPSDomain.h>
#include <fastdds/rtps/attributes/HistoryAttributes.h>
#include <fastdds/rtps/attributes/RTPSParticipantAttributes.h>
#include <fastdds/rtps/attributes/ReaderAttributes.h>
#include <fastdds/rtps/history/ReaderHistory.h>
#include <fastdds/rtps/participant/RTPSParticipant.h>
#include <fastdds/rtps/reader/RTPSReader.h>
#include <fastdds/rtps/reader/ReaderListener.h>
#include <fastrtps/attributes/TopicAttributes.h>
#include <fastrtps/qos/ReaderQos.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <iterator>
#include <mutex>

#include "core/error.hpp"
#include "ros2/fast_endpoints.hpp"
#include "ros2/message_queue.hpp"
#include "ros2/network.hpp"

namespace stdc::ros2 {
namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

constexpr std::uint32_t kMaxMessage = 256U << 20U;  // [bytes]; no image of a camera is larger

rtps::HistoryAttributes history_attributes() {
  constexpr std::uint32_t kFirstCapacity = 512;  // of a message's memory, which grows as needed
  return {rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE, kFirstCapacity, 1, MessageQueue::kMaxUntaken};
}

/// Holds messages of which parts are missing, or earlier ones are. Accepts no more while the queue is full.
class ThrottledHistory : public rtps::ReaderHistory {
 public:
  explicit ThrottledHistory(const MessageQueue& queue)
      : rtps::ReaderHistory(history_attributes()), queue_(queue) {}

  bool can_change_be_added_nts(const rtps::GUID_t& /*writer*/, std::uint32_t size, std::size_t missing_before,
                               bool& will_never_be_accepted) const override {
    will_never_be_accepted = size > kMaxMessage;
    if (will_never_be_accepted || queue_.is_full()) return false;
    // Room is kept for those that come before it, else they and it would wait for each other.
    return missing_before == 0 || m_changes.size() + missing_before < MessageQueue::kMaxUntaken;
  }

 private:
  const MessageQueue& queue_;
};

rtps::ReaderAttributes reader_attributes() {
  rtps::ReaderAttributes attributes;
  attributes.endpoint.reliabilityKind = rtps::RELIABLE;
  attributes.endpoint.durabilityKind = rtps::VOLATILE;
  attributes.endpoint.topicKind = rtps::NO_KEY;
  dds::DataSharingQosPolicy no_sharing;
  no_sharing.off();
  attributes.endpoint.set_data_sharing_configuration(no_sharing);
  attributes.times.heartbeatResponseDelay = {0, 0};  // who waits for us shall not wait longer
  return attributes;
}

class ReliableSubscription : public Subscription, private rtps::ReaderListener {
 public:
  ReliableSubscription(rtps::RTPSParticipant& participant, const std::string& wire_name,
                       const std::string& wire_type, const Delivery& delivery,
                       std::function<void()> on_message)
      : on_message_(std::move(on_message)), queue_(delivery.depth), history_(queue_) {
    rtps::ReaderAttributes attributes = reader_attributes();
    reader_ = rtps::RTPSDomain::createRTPSReader(&participant, attributes, &history_, this);
    if (reader_ == nullptr) throw Error(wire_name, "cannot be subscribed to", kEndpointHint);
    eprosima::fastrtps::TopicAttributes topic(wire_name.c_str(), wire_type.c_str());
    topic.auto_fill_type_object = false;
    topic.auto_fill_type_information = false;
    dds::ReaderQos qos;
    qos.m_reliability.kind = dds::RELIABLE_RELIABILITY_QOS;
    qos.m_durability.kind = dds::VOLATILE_DURABILITY_QOS;
    qos.data_sharing.off();
    if (participant.registerReader(reader_, topic, qos)) return;
    rtps::RTPSDomain::removeRTPSReader(reader_);
    throw Error(wire_name, "cannot be subscribed to", kEndpointHint);
  }
  ~ReliableSubscription() override {
    reader_->setListener(nullptr);
    rtps::RTPSDomain::removeRTPSReader(reader_);
  }

  std::optional<std::vector<std::uint8_t>> take() override { return queue_.pop(); }
  int publishers() const override { return publishers_; }
  int lost() const override { return lost_; }
  std::string incompatibility() const override {
    const std::lock_guard lock(mutex_);
    return incompatibility_;
  }

 private:
  // With the reader's lock held: nobody else changes the history meanwhile.
  void on_data_available(rtps::RTPSReader* /*reader*/, const rtps::GUID_t& writer,
                         const rtps::SequenceNumber_t& first, const rtps::SequenceNumber_t& last,
                         bool& notify_each) override {
    notify_each = false;
    // By what is there, not by the numbers: a publisher may leave out as many as it likes.
    std::vector<rtps::CacheChange_t*> changes;
    std::copy_if(history_.changesBegin(), history_.changesEnd(), std::back_inserter(changes),
                 [&](rtps::CacheChange_t* change) {
                   return change->is_fully_assembled() && change->writerGUID == writer &&
                          first <= change->sequenceNumber && change->sequenceNumber <= last;
                 });
    for (rtps::CacheChange_t* change : changes) {
      if (change->kind == rtps::ALIVE) {
        const auto& payload = change->serializedPayload;
        lost_ += queue_.push({payload.data, payload.data + payload.length});
      }
      history_.remove_change(change);
    }
    if (on_message_) on_message_();
  }
  void onReaderMatched(rtps::RTPSReader* /*reader*/, const dds::SubscriptionMatchedStatus& status) override {
    publishers_ = status.current_count;
  }
  void onReaderMatched(rtps::RTPSReader* /*reader*/, rtps::MatchingInfo& /*info*/) override {}
  void on_sample_lost(rtps::RTPSReader* /*reader*/, std::int32_t more) override { lost_ += more; }
  void on_requested_incompatible_qos(rtps::RTPSReader* /*reader*/, dds::PolicyMask policies) override {
    for (std::size_t policy = 0; policy < policies.size(); ++policy) {
      if (!policies.test(policy)) continue;
      const std::lock_guard lock(mutex_);
      incompatibility_ = policy_name(static_cast<dds::QosPolicyId_t>(policy));
    }
  }

  std::function<void()> on_message_;
  MessageQueue queue_;
  ThrottledHistory history_;
  std::atomic<int> publishers_ = 0, lost_ = 0;
  mutable std::mutex mutex_;
  std::string incompatibility_;
  rtps::RTPSReader* reader_ = nullptr;  ///< of the domain
};

}  // namespace

class ReliableParticipant::Implementation {
 public:
  explicit Implementation(const NodeOptions& options) {
    const Network network = make_network(options);
    rtps::RTPSParticipantAttributes attributes;
    attributes.setName("stdc_slam_images");
    attributes.useBuiltinTransports = false;
    attributes.userTransports.push_back(network.transport);
    for (const rtps::Locator_t& peer : network.initial_peers) {
      attributes.builtin.initialPeersList.push_back(peer);
    }
    attributes.userData.assign(network.user_data.begin(), network.user_data.end());
    participant_ =
        rtps::RTPSDomain::createParticipant(static_cast<std::uint32_t>(options.domain), attributes);
    if (participant_ == nullptr) {
      throw Error(fmt::format("ROS 2 domain {}", options.domain), "cannot be joined", kNetworkHint);
    }
  }
  ~Implementation() { rtps::RTPSDomain::removeRTPSParticipant(participant_); }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  rtps::RTPSParticipant& participant() { return *participant_; }

 private:
  rtps::RTPSParticipant* participant_ = nullptr;  ///< of the domain
};

ReliableParticipant::ReliableParticipant(const NodeOptions& options)
    : implementation_(std::make_unique<Implementation>(options)) {}
ReliableParticipant::~ReliableParticipant() = default;

std::unique_ptr<Subscription> ReliableParticipant::subscribe(const std::string& wire_name,
                                                             const std::string& wire_type,
                                                             const Delivery& delivery,
                                                             std::function<void()> on_message) {
  return std::make_unique<ReliableSubscription>(implementation_->participant(), wire_name, wire_type,
                                                delivery, std::move(on_message));
}

}  // namespace stdc::ros2
