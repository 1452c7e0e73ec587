#include "server/wire/messages.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

TEST(Messages, ReadBackAsTheyWereWritten) {
  Order order{.number = 7, .kind = OrderKind::bakeFile, .scene = "abc", .isStored = true, .milliseconds = 12.5};
  order.mediaType = "image/png";
  order.light = 3;
  const auto read = readToWorker(textOf(ToWorker{.order = order}));
  ASSERT_TRUE(read && read->order);
  EXPECT_EQ(read->order->number, 7u);
  EXPECT_EQ(read->order->kind, OrderKind::bakeFile);
  EXPECT_TRUE(read->order->isStored);
  EXPECT_EQ(read->order->milliseconds, 12.5);
  EXPECT_EQ(read->order->light, 3);
  EXPECT_FALSE(read->start || read->cancel || read->forget || read->lightMap);
}

TEST(Messages, ProblemsAndStagesArriveWhole) {
  Outcome outcome{.number = 1, .problems = {{ProblemCode::tooLarge, "/views", "Too large.", "1", "2"}}};
  outcome.stages = {{"load", 1.5}, {"shade", 2}};
  const auto read = readToFront(textOf(ToFront{.outcome = outcome}));
  ASSERT_TRUE(read && read->outcome);
  ASSERT_EQ(read->outcome->problems.size(), 1u);
  EXPECT_EQ(read->outcome->problems[0].code, ProblemCode::tooLarge);
  EXPECT_EQ(read->outcome->problems[0].pointer, "/views");
  EXPECT_EQ(read->outcome->problems[0].actual, "2");
  ASSERT_EQ(read->outcome->stages.size(), 2u);
  EXPECT_EQ(read->outcome->stages[1].stage, "shade");
}

TEST(Messages, TextThatIsNoUtf8IsReplaced) {
  const auto read = readToFront(textOf(ToFront{.event = OrderEvent{1, "row", "\xff"}}));
  ASSERT_TRUE(read && read->event);
  EXPECT_EQ(read->event->data, "?");
}

TEST(Messages, WhatIsNoneIsRefused) {
  for (const char* text :
       {"", "{}", "[]", "{\"cancel\":{\"number\":1},\"forget\":{\"scene\":\"a\"}}", "{\"cancel\":{\"number\":-1}}",
        "{\"cancel\":{\"nummer\":1}}", "{\"cancel\":1}", "{\"order\":{\"kind\":\"nothing\"}}", "{\"ready\":{}}"}) {
    EXPECT_FALSE(readToWorker(text)) << text;
  }
  EXPECT_FALSE(readToFront("{\"cancel\":{\"number\":1}}"));
}

} // namespace
} // namespace gnomon
