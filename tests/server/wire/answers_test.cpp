#include "server/wire/answers.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "protocol/json/json_codec.h"
#include "server/wire/sequence_news.h"

namespace gnomon {
namespace {

const std::string kScene(64, 'a');

Order orderOf(OrderKind kind, std::string mediaType = "") {
  return {.number = 1, .kind = kind, .scene = kScene, .mediaType = std::move(mediaType), .boundary = "gnomon-1"};
}

/// Whether a result of this body can end the order.
bool ends(const Order& order, std::optional<SharedBytes> body, const Announced& announced = {}) {
  return mayEnd(order, Outcome{.number = 1, .contentType = resultType(order)}, body, announced);
}

bool mayBeSent(const Order& order, const std::string& name, const std::string& data = "{}") {
  Announced announced;
  return maySend(order, {1, name, data}, announced);
}

std::string summaryOf(const std::string& id) {
  SceneSummary summary;
  summary.id = id;
  return jsonText(toJson(summary));
}

TEST(Answers, AResultHasTheTypeThatWasAskedFor) {
  const Order png = orderOf(OrderKind::frame, "image/png");
  EXPECT_TRUE(ends(png, "picture"));
  EXPECT_FALSE(ends(png, std::nullopt));
  EXPECT_FALSE(ends(png, ""));
  for (const char* type : {"text/html", "image/png\r\nX: y", "image/png; a=b", ""}) {
    EXPECT_FALSE(mayEnd(png, {.number = 1, .contentType = type}, "picture", {})) << type;
  }
  EXPECT_EQ(resultType(orderOf(OrderKind::frame, "multipart/mixed")), "multipart/mixed; boundary=gnomon-1");
  EXPECT_TRUE(mayEnd(png, {.number = 1, .problems = {Problem{}}}, std::nullopt, {}));
}

TEST(Answers, ALoadedSceneHasASummaryOfItsOwn) {
  const Order load = orderOf(OrderKind::load);
  EXPECT_TRUE(ends(load, summaryOf(kScene)));
  EXPECT_FALSE(ends(load, summaryOf(std::string(64, 'b')))) << "of another scene";
  for (const char* body : {"", "no JSON", "{}", "[]", "{\"id\":1}", "{"}) EXPECT_FALSE(ends(load, body)) << body;
  EXPECT_FALSE(ends(load, summaryOf(kScene) + "\n")) << "not as it is written";
}

TEST(Answers, ReportsAreJsonOfOneLine) {
  for (const Order& order :
       {orderOf(OrderKind::plan), orderOf(OrderKind::nodes), orderOf(OrderKind::evaluation, "text/event-stream"),
        orderOf(OrderKind::bake, "application/json")}) {
    EXPECT_TRUE(ends(order, "{\"a\":1}"));
    EXPECT_FALSE(ends(order, "{\"a\":1"));
    EXPECT_FALSE(ends(order, "{\"a\":\n\n1}")) << "a line end would begin another event";
  }
  EXPECT_TRUE(ends(orderOf(OrderKind::evaluation, "text/csv"), "a,b\r\n1,2\r\n"));
}

TEST(Answers, ABakeOfEventsHasNoBody) {
  const Order bake = orderOf(OrderKind::bake, "text/event-stream");
  EXPECT_TRUE(ends(bake, std::nullopt));
  EXPECT_FALSE(ends(bake, "{}"));
}

TEST(Answers, EventsAreThoseOfTheirOrder) {
  const Order evaluation = orderOf(OrderKind::evaluation, "text/event-stream");
  EXPECT_TRUE(mayBeSent(evaluation, "progress") && mayBeSent(evaluation, "row"));
  for (const char* name : {"", "result", "problem", "news", "progress\n\nevent: problem"})
    EXPECT_FALSE(mayBeSent(evaluation, name)) << name;
  EXPECT_FALSE(mayBeSent(orderOf(OrderKind::evaluation, "application/json"), "progress")) << "no events were asked for";
  EXPECT_FALSE(mayBeSent(orderOf(OrderKind::frame, "image/png"), "progress"));
  EXPECT_TRUE(mayBeSent(orderOf(OrderKind::bake, "text/event-stream"), "result"));
  const Order frame = orderOf(OrderKind::sequenceFrame);
  EXPECT_TRUE(mayBeSent(frame, "news", textOf(SequenceNews{.drawn = DrawnNews{}})));
  EXPECT_FALSE(mayBeSent(frame, "news", "{}"));
}

TEST(Answers, AFrameOfASequenceHasTheBytesThatItAnnounced) {
  const Order frame = orderOf(OrderKind::sequenceFrame);
  Announced announced;
  EXPECT_FALSE(ends(frame, "12345", announced)) << "nothing was announced";
  const SequenceNews news{.pictures = {{"color", "image/png", 5}}};
  ASSERT_TRUE(maySend(frame, {1, std::string(kSequenceNews), textOf(news)}, announced));
  EXPECT_TRUE(ends(frame, "12345", announced));
  EXPECT_FALSE(ends(frame, "1234", announced));
  EXPECT_FALSE(ends(frame, "123456", announced));
}

} // namespace
} // namespace gnomon
