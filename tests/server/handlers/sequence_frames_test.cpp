#include "server/handlers/sequence_frames.h"

#include <atomic>
#include <gtest/gtest.h>
#include <pthread.h>

#include "server/jobs/local_jobs.h"
#include "server/scenes/upload.h"
#include "tests/support/glb_builder.h"

namespace gnomon {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kFrameBytes = 64 * 64 * 12; ///< and the head of its file

/// While it lives, the system refuses every further thread: none has room for such a stack.
class NoThreads {
 public:
  NoThreads() {
    pthread_getattr_default_np(&usual_);
    pthread_attr_t vast;
    pthread_attr_init(&vast);
    pthread_attr_setstacksize(&vast, std::size_t{1} << 50);
    EXPECT_EQ(pthread_setattr_default_np(&vast), 0);
    pthread_attr_destroy(&vast);
  }
  ~NoThreads() {
    pthread_setattr_default_np(&usual_);
    pthread_attr_destroy(&usual_);
  }
  NoThreads(const NoThreads&) = delete;
  NoThreads& operator=(const NoThreads&) = delete;

 private:
  pthread_attr_t usual_;
};

/// Real workers and frames of some 48 KiB, in little room.
class SequenceFramesTest : public ::testing::Test {
 protected:
  SequenceFramesTest() { services_.replyRoom = 50ms; }

  std::shared_ptr<SequenceFrames> sequence(int count) {
    std::string patches = "{}";
    for (int i = 1; i < count; ++i) patches += R"(, {"exposure": )" + std::to_string(0.1 * i) + "}";
    return sequenceOf(patches);
  }

  std::shared_ptr<SequenceFrames> sequenceOf(const std::string& patches) {
    auto request = decodeSequence(
        R"({"spec": {"width": 64, "height": 64,
                     "output": {"format": "exr", "exrPixelType": "float", "exrCompression": "none"}},
            "frames": [)" +
        patches + "]}");
    EXPECT_TRUE(request);
    Task task;
    task.order.kind = OrderKind::sequenceFrame;
    task.order.scene = scene_.id;
    task.bundle = scene_.file;
    task.deadline = Clock::now() + 60s;
    task.lane = Lane::sequence;
    task.client = {"test", "test"};
    return std::make_shared<SequenceFrames>(services_, *std::move(request), SceneCounts(), std::move(task), nullptr,
                                            [] { return false; });
  }

  static std::string problemOf(const DoneFrame& frame) {
    return frame.problems.empty() ? "" : std::string(problemName(frame.problems[0].code));
  }

  std::unique_ptr<Dispatcher> start() {
    DispatcherOptions options;
    options.program = GNOMON_FAULTY_WORKER;
    options.workers = 2;
    options.waited = [this](Lane, double) { ++drawn_; };
    options.each.device = DeviceChoice::cpu;
    return *Dispatcher::start(options);
  }

  std::atomic<std::size_t> drawn_ = 0; ///< tasks that went to a worker
  PackedBundle scene_ = *packed(testing::cube().bundle());
  std::unique_ptr<SceneStore> store_ = *SceneStore::open({});
  std::unique_ptr<Dispatcher> workers_ = start();
  ByteBudget room_{5 * kFrameBytes / 2};
  LocalJobs jobs_{{}, ""};
  Services services_{
      .store = *store_, .workers = *workers_, .replyBytes = room_, .jobs = jobs_, .limits = kLimits, .page = {}};
};

TEST_F(SequenceFramesTest, ThoseThatNobodyTakesHoldNoMoreThanThereIs) {
  std::vector<std::shared_ptr<SequenceFrames>> sequences;
  std::vector<DoneFrame> held;
  for (int i = 0; i < 2; ++i) {
    sequences.push_back(sequence(6));
    held.push_back(sequences.back()->next([] {}));
    ASSERT_EQ(problemOf(held.back()), "");
    EXPECT_EQ(held.back().room->held(), held.back().pictures.bytes().size());
  }
  EXPECT_LE(room_.used(), room_.total());
  DoneFrame refused = sequence(1)->next([] {});
  EXPECT_EQ(problemOf(refused), "unavailable") << "as any reply that finds no room";
  EXPECT_EQ(refused.result.refusal, TaskRefusal::memory);

  held.clear();
  std::vector<std::thread> clients;
  for (const auto& frames : sequences) {
    clients.emplace_back([&frames] {
      for (int index = 1; !frames->atEnd(); ++index) {
        const DoneFrame frame = frames->next([] {});
        ASSERT_EQ(problemOf(frame), "");
        EXPECT_EQ(frame.index, index);
        EXPECT_GT(frame.pictures.bytes().size(), kFrameBytes);
      }
    });
  }
  for (std::thread& client : clients) client.join();
  EXPECT_EQ(room_.used(), 0u);
}

TEST_F(SequenceFramesTest, OneThatFindsNoRoomIsDroppedAndDrawnAgainWithTheSameBytes) {
  const std::string patches = R"({}, {"width": 128})";
  const auto whole = sequenceOf(patches);
  whole->next([] {});
  const SharedBytes expected = whole->next([] {}).pictures.bytes();

  const auto frames = sequenceOf(patches);
  frames->next([] {});
  const std::size_t atFirst = drawn_;
  std::optional<ByteLease> others(room_);
  ASSERT_TRUE(others->grow(room_.total() - 3 * kFrameBytes / 2)); // as much is left as the first frame took
  std::thread reader([&] {
    const DoneFrame second = frames->next([] {});
    EXPECT_EQ(problemOf(second), "");
    EXPECT_TRUE(second.pictures.bytes() == expected.view());
  });
  const auto end = Clock::now() + 30s;
  const auto isDropped = [&] { return drawn_ > atFirst && room_.used() == others->held(); };
  while (!isDropped() && Clock::now() < end) std::this_thread::sleep_for(1ms);
  EXPECT_TRUE(isDropped());
  others.reset();
  reader.join();
  EXPECT_EQ(drawn_, atFirst + 2);
  EXPECT_EQ(room_.used(), 0u);
}

TEST_F(SequenceFramesTest, AFrameForWhichThereIsNoThreadIsAProblem) {
  const auto frames = sequence(2);
  {
    const NoThreads noThreads;
    const DoneFrame frame = frames->next([] {});
    EXPECT_EQ(problemOf(frame), "unavailable");
    EXPECT_EQ(frame.problems.front().pointer, "/frames/0");
  }
  EXPECT_EQ(problemOf(sequence(1)->next([] {})), "") << "the next sequence is drawn";
}

} // namespace
} // namespace gnomon
