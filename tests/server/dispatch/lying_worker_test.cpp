// Workers whose parser was taken over: what they say costs them, and nothing else.
#include <atomic>

#include "server/handlers/handlers.h"
#include "server/handlers/work.h"
#include "server/jobs/local_jobs.h"
#include "tests/server/dispatch/dispatcher_fixture.h"

namespace gnomon {
namespace {

using testing::DispatcherTest;
using testing::kStays;

/// Counts what it is given.
class CountedLightMaps : public StoredLightMaps {
 public:
  FileDescriptor open(const std::string&) override { return {}; }
  void write(const std::string&, const FileDescriptor&) override { ++written; }
  void removeScene(const std::string&) override {}
  void cleanUp() override {}

  std::atomic<int> written = 0;
};

class LyingWorkerTest : public DispatcherTest {
 protected:
  /// It is tried with two workers, both are replaced, and the next task finds one that works.
  void expectReplaced(const Task& lie, const std::string& name) {
    const auto lightMaps = std::make_shared<CountedLightMaps>();
    const auto dispatcher = start(1, {.each = {.keepsLightMaps = true}, .lightMaps = lightMaps});
    const TaskResult result = dispatcher->run(lie, kStays);
    ASSERT_EQ(problemOf(result), "internal") << name;
    EXPECT_EQ(result.outcome.problems[0].detail, "Two workers ended over this request. It sent what is no message.");
    EXPECT_EQ(problemOf(dispatcher->run(frame(), kStays)), "") << name;
    EXPECT_EQ(dispatcher->state().replacements, (std::array<std::uint64_t, kWorkerEnds>{2, 0, 0, 0})) << name;
    EXPECT_EQ(lightMaps->written, 0) << name;
  }
};

TEST_F(LyingWorkerTest, AResultIsASealedFileOfTheTypeThatWasAskedFor) {
  for (const char* lie : {"lie-pipe", "lie-eventfd", "lie-unsealed", "lie-hollow", "lie-nothing", "lie-type"}) {
    expectReplaced(frame(lie), lie);
  }
}

TEST_F(LyingWorkerTest, NothingBecomesAHeaderThatIsNone) {
  expectReplaced(frame("lie-head"), "lie-head");
}

TEST_F(LyingWorkerTest, OrdersAreThoseThatItHas) {
  for (const char* lie : {"lie-number", "lie-finished"}) expectReplaced(frame(lie), lie);
}

TEST_F(LyingWorkerTest, ItStartsOnceAndRefusesWithAReason) {
  for (const char* lie : {"lie-refusal", "lie-start", "lie-giant"}) expectReplaced(frame(lie), lie);
}

TEST_F(LyingWorkerTest, LightMapsAreThoseOfScenesThatItWorksOn) {
  for (const char* lie : {"lie-map", "lie-own-map"}) expectReplaced(frame(lie), lie);
}

TEST_F(LyingWorkerTest, PicturesOfAFrameAddUpToItsBytes) {
  for (const char* lie : {"lie-wrap", "lie-short", "lie-view"}) {
    Task task = frame(lie);
    task.order.kind = OrderKind::sequenceFrame;
    expectReplaced(task, lie);
  }
}

TEST_F(LyingWorkerTest, ItsWordAloneRemovesNoScene) {
  const std::string folder = ::testing::TempDir() + "lying_worker_store";
  const auto store = *SceneStore::open({.directory = folder});
  ASSERT_TRUE(store->put(scene_.id, scene_.file, scene_.bytes, "{}"));
  const auto workers = start(1);
  ByteBudget room(1 << 20);
  LocalJobs jobs({}, "");
  Services services{
      .store = *store, .workers = *workers, .replyBytes = room, .jobs = jobs, .limits = kLimits, .page = {}};
  Task task = frame("lie-damaged");
  const auto stored = store->bundle(scene_.id);
  ASSERT_TRUE(stored);
  task.bundle = stored->file;
  task.order.isStored = true;
  EXPECT_EQ(problemOf(runTask(services, task, kStays)), "internal");
  EXPECT_TRUE(store->contains(scene_.id));
  EXPECT_TRUE(store->remove(scene_.id));
}

} // namespace
} // namespace gnomon
