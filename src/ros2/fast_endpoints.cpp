#include "ros2/fast_endpoints.hpp"

#include <fmt/format.h>

#include <atomic>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <mutex>

#include "core/error.hpp"
#include "ros2/message_queue.hpp"
#include "ros2/network.hpp"

namespace stdc::ros2 {
namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

constexpr int kMaxKept = 16;                      // by a publisher that drops none, while others are busy
constexpr std::uint32_t kHeartbeat = 50'000'000;  // [ns]

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

/// Messages are taken out of the middleware as they come, into a queue of our own: Fast DDS 2.9 fails an
/// assertion when it drops an old message of a full history while another thread takes one.
class FastSubscription : public Subscription, private dds::DataReaderListener {
 public:
  FastSubscription(dds::Subscriber& subscriber, dds::Topic& topic, const Delivery& delivery,
                   std::function<void()> on_message)
      : subscriber_(subscriber), on_message_(std::move(on_message)), queue_(delivery.depth) {
    dds::DataReaderQos qos = subscriber.get_default_datareader_qos();
    set_delivery(delivery, qos);
    qos.reliable_reader_qos().times.heartbeatResponseDelay = {0,
                                                              0};  // who waits for us shall not wait longer
    dds::DataReader* const made = subscriber.create_datareader(&topic, qos, this, dds::StatusMask::all());
    reader_ = made;
    if (made == nullptr) throw Error(topic.get_name(), "cannot be subscribed to", kEndpointHint);
  }
  ~FastSubscription() override {
    dds::DataReader* const reader = reader_;
    reader->set_listener(nullptr);
    subscriber_.delete_datareader(reader);
  }

  std::optional<std::vector<std::uint8_t>> take() override { return queue_.pop(); }
  int publishers() const override { return publishers_; }
  int lost() const override { return lost_ + overflown_; }
  std::string incompatibility() const override {
    const std::lock_guard lock(mutex_);
    return incompatibility_;
  }

 private:
  std::optional<std::vector<std::uint8_t>> take_from_middleware() {
    std::vector<std::uint8_t> bytes;
    dds::SampleInfo info;
    while (reader_.load()->take_next_sample(&bytes, &info) == ReturnCode_t::RETCODE_OK) {
      if (info.valid_data) return bytes;  // else the publisher said that it goes
    }
    return std::nullopt;
  }

  void on_data_available(dds::DataReader* reader) override {
    // The first messages may come before create_datareader() has returned.
    reader_ = reader;
    while (auto message = take_from_middleware()) {
      overflown_ += queue_.push(std::move(*message));
    }
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
  MessageQueue queue_;
  std::atomic<int> publishers_ = 0, lost_ = 0, overflown_ = 0;
  mutable std::mutex mutex_;
  std::string incompatibility_;
  std::atomic<dds::DataReader*> reader_ = nullptr;  ///< of the subscriber
};

class FastPublication : public Publication, private dds::DataWriterListener {
 public:
  FastPublication(dds::Publisher& publisher, dds::Topic& topic, const Delivery& delivery)
      : publisher_(publisher) {
    dds::DataWriterQos qos = publisher.get_default_datawriter_qos();
    set_delivery(delivery, qos);
    // Where a reader leaves, Fast DDS 2.9 takes what all others have out of a volatile writer's history, and
    // may wait for its own sending thread, which waits for it: publishing would stand still for ever. Of
    // other writers' nothing is taken out then, and volatile readers get no old messages from them either.
    if (delivery.depth > 0) qos.durability().kind = dds::TRANSIENT_LOCAL_DURABILITY_QOS;
    qos.publish_mode().kind = delivery.large ? dds::ASYNCHRONOUS_PUBLISH_MODE : dds::SYNCHRONOUS_PUBLISH_MODE;
    // What is lost must not hold up odometry for the three seconds of Fast DDS's default.
    qos.reliable_writer_qos().times.heartbeatPeriod = {0, kHeartbeat};
    qos.reliable_writer_qos().times.nackResponseDelay = {0, 0};
    writer_ = publisher.create_datawriter(&topic, qos, this, dds::StatusMask::all());
    if (writer_ == nullptr) throw Error(topic.get_name(), "cannot be published", kEndpointHint);
  }
  ~FastPublication() override {
    writer_->set_listener(nullptr);
    // Fast DDS 2.9 gives the messages back one by one while heartbeats still count them, and counts for ever
    // if it finds one that has gone: the program was seen to hang at its end. Of an empty history nothing is
    // counted.
    std::size_t removed = 0;
    writer_->clear_history(&removed);
    publisher_.delete_datawriter(writer_);
  }

  bool publish(Bytes message) override {
    sample_.assign(message.begin(), message.end());
    return writer_->write(&sample_);
  }
  void flush() override { writer_->wait_for_acknowledgments({1, 0}); }
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

}  // namespace

std::string policy_name(dds::QosPolicyId_t policy) {
  if (policy == dds::RELIABILITY_QOS_POLICY_ID) return "reliability";
  if (policy == dds::DURABILITY_QOS_POLICY_ID) return "durability";
  return fmt::format("policy {}", static_cast<int>(policy));
}

std::unique_ptr<Subscription> make_subscription(dds::Subscriber& subscriber, dds::Topic& topic,
                                                const Delivery& delivery, std::function<void()> on_message) {
  return std::make_unique<FastSubscription>(subscriber, topic, delivery, std::move(on_message));
}

std::unique_ptr<Publication> make_publication(dds::Publisher& publisher, dds::Topic& topic,
                                              const Delivery& delivery) {
  return std::make_unique<FastPublication>(publisher, topic, delivery);
}

}  // namespace stdc::ros2
