#include "server/dispatch/placement.h"

#include <gtest/gtest.h>
#include <map>

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

TEST(Placement, WhoeverIsTakenGivesToAnIdleOneOrLetsWait) {
  auto workers = ready(2);
  const std::size_t own = *placeFor(task("a"), workers);
  workers[own].running[0] = kPlaces[0];
  EXPECT_EQ(placeFor(task("a"), workers), 1 - own);
  workers[1 - own].running[0] = 1;
  EXPECT_FALSE(placeFor(task("a"), workers)) << "the other one is not idle, and would have to load the scene";
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
