#include "server/dispatch/placement.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <random>

namespace gnomon {
namespace {

Task task(const std::string& scene, Lane lane = Lane::interactive) {
  Task made;
  made.order.scene = scene;
  made.lane = lane;
  return made;
}

std::vector<WorkerView> ready(std::size_t count) {
  return std::vector<WorkerView>(count, WorkerView{.ready = true});
}

TEST(Placement, ScenesStayWithTheirWorkerAndSpreadOverAll) {
  std::map<std::size_t, int> scenes;
  for (int i = 0; i < 1000; ++i) {
    const auto place = placeFor(task(std::to_string(i)), ready(4));
    ASSERT_TRUE(place);
    EXPECT_EQ(place, placeFor(task(std::to_string(i)), ready(4)));
    ++scenes[*place];
  }
  for (const auto& [worker, count] : scenes) EXPECT_NEAR(count, 250, 60) << worker;
}

TEST(Placement, KinStayTogether) {
  std::map<std::size_t, int> places;
  for (int i = 0; i < 100; ++i) {
    Task made = task(std::to_string(i));
    made.affinityKey = "of one client";
    ++places[placeFor(made, ready(4)).value()];
  }
  EXPECT_EQ(places.size(), 1u);
}

TEST(Placement, OnlyTheScenesOfAWorkerThatIsGoneMove) {
  auto without = ready(4);
  without[2].ready = false;
  for (int i = 0; i < 1000; ++i) {
    const auto place = placeFor(task(std::to_string(i)), ready(4));
    const auto then = placeFor(task(std::to_string(i)), without);
    ASSERT_TRUE(then);
    EXPECT_TRUE(*place == 2 || place == then);
    EXPECT_NE(*then, 2u);
  }
}

TEST(Placement, AFrameGoesToAnIdleWorkerBeforeItWaitsBehindAnother) {
  auto workers = ready(2);
  const std::size_t own = *placeFor(task("a"), workers);
  workers[own].running[0] = 1; // which may be a large one
  EXPECT_EQ(placeFor(task("a"), workers), 1 - own);
  workers[1 - own].running[0] = 1;
  EXPECT_EQ(placeFor(task("a"), workers), own) << "none is idle, and this one has the scene";
  workers[own].running[0] = kPlaces[0];
  EXPECT_FALSE(placeFor(task("a"), workers)) << "the other one is not idle, and would have to load the scene";
}

/// Any load that workers may have.
std::vector<WorkerView> randomLoad(std::mt19937& random) {
  const auto upTo = [&](std::size_t most) { return std::uniform_int_distribution<std::size_t>(0, most)(random); };
  auto workers = ready(1 + upTo(5));
  for (WorkerView& worker : workers) {
    worker.ready = upTo(7) > 0;
    worker.reserved = upTo(7) == 0;
    if (upTo(2) == 0) continue;
    for (std::size_t lane = 0; lane < kLanes; ++lane) worker.running[lane] = upTo(kPlaces[lane]);
    worker.holdingRenderer = upTo(std::min<std::size_t>(worker.all(), 1));
  }
  return workers;
}

TEST(Placement, ATaskIsBehindAnotherOrWaitsOnlyWhereNoWorkerIsIdle) {
  std::mt19937 random(41);
  std::size_t toIdle = 0, behind = 0, waiting = 0;
  for (int i = 0; i < 50'000; ++i) {
    const auto workers = randomLoad(random);
    Task asked = task(std::to_string(i), static_cast<Lane>(i % kLanes));
    asked.holdsRenderer = i % 5 == 0;
    const auto place = placeFor(asked, workers);
    const bool anyIdle = std::any_of(workers.begin(), workers.end(), [](const WorkerView& worker) {
      return worker.ready && !worker.reserved && worker.all() == 0;
    });
    const auto held = static_cast<std::size_t>(
        std::count_if(workers.begin(), workers.end(), [](const auto& worker) { return worker.holdingRenderer > 0; }));
    const bool mustWait = asked.holdsRenderer && workers.size() > 1 && held + 1 >= workers.size();
    if (place) {
      const WorkerView& own = workers[*place];
      ASSERT_TRUE(own.ready && !own.reserved &&
                  own.running[static_cast<std::size_t>(asked.lane)] < kPlaces[i % kLanes]);
      ASSERT_FALSE(mustWait);
      ASSERT_TRUE(own.all() == 0 || !anyIdle) << i;
      ++(own.all() == 0 ? toIdle : behind);
    } else {
      ASSERT_TRUE(!anyIdle || mustWait) << i;
      ++waiting;
    }
  }
  EXPECT_GT(toIdle, 1'000u);
  EXPECT_GT(behind, 1'000u);
  EXPECT_GT(waiting, 1'000u);
}

TEST(Placement, LanesDoNotStandBeforeEachOther) {
  auto workers = ready(1);
  workers[0].running[static_cast<std::size_t>(Lane::batch)] = kPlaces[1];
  EXPECT_FALSE(placeFor(task("a", Lane::batch), workers));
  EXPECT_TRUE(placeFor(task("a"), workers));
  EXPECT_TRUE(placeFor(task("a", Lane::load), workers));
}

TEST(Placement, ATaskThatHoldsTheRendererLeavesAWorkerToOthers) {
  Task slow = task("a", Lane::batch);
  slow.holdsRenderer = true;
  auto workers = ready(2);
  const std::size_t first = *placeFor(slow, workers);
  workers[first].running[1] = 1;
  workers[first].holdingRenderer = 1;
  EXPECT_FALSE(placeFor(slow, workers)) << "one worker stays free of them";
  workers[1 - first].running[0] = 1;
  EXPECT_EQ(placeFor(task("a"), workers), 1 - first) << "and takes the others, though it is not idle";
  EXPECT_TRUE(placeFor(slow, ready(1))) << "a single worker takes everything";
}

TEST(Placement, WhoMustBeAloneWaitsForAnEmptyWorker) {
  auto workers = ready(2);
  workers[0].running[0] = workers[1].running[0] = 1;
  const auto lone = lonePlaceFor(task("a"), workers);
  ASSERT_TRUE(lone);
  EXPECT_FALSE(lone->free);
  workers[lone->worker].running[0] = 0;
  EXPECT_TRUE(lonePlaceFor(task("a"), workers)->free);
  workers[lone->worker].reserved = true;
  EXPECT_NE(placeFor(task("a"), workers), lone->worker);
  workers[0].ready = workers[1].ready = false;
  EXPECT_FALSE(lonePlaceFor(task("a"), workers));
  EXPECT_FALSE(placeFor(task("a"), workers));
}

} // namespace
} // namespace gnomon
