// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// What a source's cameras publish together.
#include "nodes/source_reader.h"

#include <trk_bridge/CameraConstants.h>

#include <condition_variable>
#include <deque>
#include <mutex>

#include "camera_records.h"
#include "fixture.h"

namespace trk_bridge::test::source_reader_test {

using testing::ElementsAre;

/// One record, and whether the next one has already arrived.
struct Arrival {
  wire::Record record;
  bool more = false;
};

/// Returns the given records.
class ScriptedSource : public transport::Source {
 public:
  explicit ScriptedSource(std::deque<Arrival> arrivals) : arrivals_(std::move(arrivals)) {}

  transport::Event receive(transport::Reception& into, std::chrono::nanoseconds wait) override {
    std::unique_lock<std::mutex> lock(mutex_);
    if (stopped_) return transport::Event::stopped;
    if (!arrivals_.empty()) {
      into.sample.record = arrivals_.front().record;
      into.sample.arrival = 1'700'000'000'000'000'000 + ++count_;
      into.sample.sender.kind = transport::SenderKind::file;
      into.more = arrivals_.front().more;
      arrivals_.pop_front();
      return transport::Event::sample;
    }
    if (wait.count() == 0) return transport::Event::idle;
    stop_.wait(lock, [this] { return stopped_; });
    return transport::Event::stopped;
  }
  void stop() noexcept override {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      stopped_ = true;
    }
    stop_.notify_one();
  }
  transport::SourceStatistics statistics() const override { return {}; }
  std::string name() const override { return "script"; }

 private:
  std::mutex mutex_;
  std::condition_variable stop_;
  std::deque<Arrival> arrivals_;
  std::int64_t count_ = 0;
  bool stopped_ = false;
};

/// Cameras 1 to 3 of one source.
class SourceReader : public CameraTest {
 protected:
  static constexpr int count = 3;

  SourceReader() : CameraTest("reader") {
    const ::ros::NodeHandle node(name_space);
    for (int i = 1; i <= count; ++i) {
      ros1::CameraParameters parameters;
      parameters.name = "camera" + std::to_string(i);
      parameters.frames = ros1::default_frames(camera + "_" + std::to_string(i));
      parameters.options.id = i;
      parameters.options.stamp = bridge::StampMode::arrival;
      cameras_.push_back(std::make_unique<nodes::CameraOutput>(::ros::NodeHandle(node, parameters.name), parameters,
                                                               50.0, 100, ::ros::Publisher()));
      params_.push_back(::ros::NodeHandle().subscribe<trk_bridge::CameraParams>(
          name_space + "/camera" + std::to_string(i) + "/params", 1000,
          [this, i](const trk_bridge::CameraParamsConstPtr& message) {
            received.push_back("params " + std::to_string(i) + " " + std::to_string(message->counter));
            messages.push_back(message);
          }));
    }
    tf_publisher_ = ::ros::NodeHandle(node).advertise<tf2_msgs::TFMessage>(name_space + "/tf", 1000);
    tf_ = ::ros::NodeHandle().subscribe<tf2_msgs::TFMessage>(
        name_space + "/tf", 1000, [this](const tf2_msgs::TFMessageConstPtr& message) {
          std::string text = "tf";
          for (const auto& transform : message->transforms)
            text += " " + transform.child_frame_id.substr(camera.size() + 1);
          received.push_back(text);
        });
  }
  ~SourceReader() override { reader_.reset(); }

  /// Waits until `expected` messages are received, and a little longer for unexpected ones.
  void read(std::deque<Arrival> arrivals, std::size_t expected) {
    std::vector<nodes::CameraOutput*> cameras;
    for (const auto& one : cameras_) cameras.push_back(one.get());
    reader_ = std::make_unique<nodes::SourceReader>(std::make_unique<ScriptedSource>(std::move(arrivals)), cameras,
                                                    tf_publisher_);
    reader_->start();
    EXPECT_TRUE(eventually([&] { return received.size() >= expected; }));
    EXPECT_FALSE(eventually([&] { return received.size() > expected; }, std::chrono::milliseconds(50)));
  }

  static Arrival set(std::uint64_t counter, std::uint32_t id, bool more) { return {params(counter, id), more}; }

  std::vector<std::string> received;
  std::vector<trk_bridge::CameraParamsConstPtr> messages;

  /// From now on `received` also contains these.
  void listen_to_camera_infos() {
    for (int i = 1; i <= count; ++i) {
      params_.push_back(::ros::NodeHandle().subscribe<sensor_msgs::CameraInfo>(
          name_space + "/camera" + std::to_string(i) + "/camera_info", 1000,
          [this, i](const sensor_msgs::CameraInfoConstPtr& message) {
            received.push_back("camera_info " + std::to_string(i) + " of " + std::to_string(message->width));
          }));
    }
  }

 private:
  std::vector<std::unique_ptr<nodes::CameraOutput>> cameras_;
  std::unique_ptr<nodes::SourceReader> reader_;
  std::vector<::ros::Subscriber> params_;
  ::ros::Publisher tf_publisher_;
  ::ros::Subscriber tf_;
};

TEST_F(SourceReader, SamplesThatArriveTogetherAreOneTransformMessageThatComesFirst) {
  read({set(1, 1, true), set(1, 2, true), set(1, 3, false)}, 4);
  EXPECT_THAT(received, ElementsAre("tf 1 2 3", "params 1 1", "params 2 1", "params 3 1"));
}

TEST_F(SourceReader, ASingleSampleDoesNotWait) {
  read({set(1, 1, false), set(1, 2, false)}, 4);
  EXPECT_THAT(received, ElementsAre("tf 1", "params 1 1", "tf 2", "params 2 1"));
}

TEST_F(SourceReader, ASecondSampleOfACameraComesAfterTheFirst) {
  read({set(1, 1, true), set(1, 2, true), set(2, 1, true), set(2, 2, false)}, 6);
  EXPECT_THAT(received, ElementsAre("tf 1 2", "params 1 1", "params 2 1", "tf 1 2", "params 1 2", "params 2 2"));
}

TEST_F(SourceReader, MessagesThatNeedALensFitComeLast) {
  listen_to_camera_infos();
  // The second constants are of the second field of camera 1 only.
  read({{constants(720, 1), true},
        {constants(640, 2), true},
        set(1, 1, true),
        set(1, 2, true),
        {constants(1920, 1), true},
        set(2, 1, false)},
       8);
  EXPECT_THAT(received, ElementsAre("tf 1 2", "params 1 1", "params 2 1", "camera_info 1 of 720",
                                    "camera_info 2 of 640", "tf 1", "params 1 2", "camera_info 1 of 1920"));
}

TEST_F(SourceReader, NothingWaitsForAMissingSample) {
  read({set(1, 1, true), set(1, 2, true)}, 3);
  EXPECT_THAT(received, ElementsAre("tf 1 2", "params 1 1", "params 2 1"));
}

TEST_F(SourceReader, ARecordOfNoCameraEndsAGroup) {
  read({set(1, 1, true), set(1, 9, false)}, 2);
  EXPECT_THAT(received, ElementsAre("tf 1", "params 1 1"));
}

TEST_F(SourceReader, ADuplicateAndKnownConstantsDoNotSplitAGroup) {
  read({{constants(720, 2), false},
        set(1, 1, true),
        {constants(720, 2), true},
        set(1, 1, true),
        set(1, 2, true),
        {constants(720, 2), true},
        set(1, 3, false)},
       4);
  EXPECT_THAT(received, ElementsAre("tf 1 2 3", "params 1 1", "params 2 1", "params 3 1"));
}

/// roscpp numbers only the messages that it serialises.
TEST_F(SourceReader, SubscribersInTheProcessGetMessagesByPointer) {
  std::deque<Arrival> arrivals;
  for (std::uint64_t counter = 1; counter <= 50; ++counter) arrivals.push_back(set(counter, 1, false));
  read(std::move(arrivals), 100);
  ASSERT_EQ(messages.size(), 50u);
  for (std::size_t i = 0; i < messages.size(); ++i) {
    EXPECT_EQ(messages[i]->counter, i + 1) << "a message that a subscriber keeps was written again";
    EXPECT_EQ(messages[i]->header.seq, 0u);
  }
}

}  // namespace trk_bridge::test::source_reader_test
