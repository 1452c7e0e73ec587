#include "server/wire/answers.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "protocol/json/json_codec.h"
#include "server/wire/frame_pictures.h"
#include "server/wire/sequence_news.h"

namespace gnomon {
namespace {

constexpr std::string_view kJsonType = "application/json";

struct EventRow {
  OrderKind kind;
  std::string_view name;
};
constexpr std::array kEvents{EventRow{OrderKind::sequenceFrame, kSequenceNews},
                             EventRow{OrderKind::evaluation, "progress"}, EventRow{OrderKind::evaluation, "row"},
                             EventRow{OrderKind::bake, "progress"}, EventRow{OrderKind::bake, "result"}};

bool isOneLine(std::string_view text) {
  return std::none_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; });
}

bool isJson(std::string_view text) {
  return isOneLine(text) && Json::accept(text);
}

/// In JSON no text within a text has its quotes bare.
bool isSummaryOf(const std::string& scene, std::string_view text) {
  return isJson(text) && text.starts_with('{') && text.find("\"id\":\"" + scene + '"') != std::string_view::npos;
}

} // namespace

std::string resultType(const Order& order) {
  switch (order.kind) {
    case OrderKind::load:
    case OrderKind::plan:
    case OrderKind::nodes:
      return std::string(kJsonType);
    case OrderKind::sequenceFrame:
      return "application/octet-stream";
    case OrderKind::frame:
      return order.mediaType == "multipart/mixed" ? order.mediaType + "; boundary=" + order.boundary : order.mediaType;
    case OrderKind::evaluation:
      return order.mediaType == "text/csv" ? "text/csv; charset=utf-8; header=present" : order.mediaType;
    case OrderKind::bake:
    case OrderKind::bakeFile:
      break;
  }
  return order.mediaType;
}

bool maySend(const Order& order, const OrderEvent& event, Announced& announced) {
  const bool isKnown = std::any_of(kEvents.begin(), kEvents.end(), [&](const EventRow& row) {
    return row.kind == order.kind && row.name == event.name;
  });
  if (!isKnown) return false;
  if (order.kind != OrderKind::sequenceFrame) return order.mediaType == kEventStream;
  const auto news = readSequenceNews(event.data);
  if (news && !news->pictures.empty()) announced.pictureBytes = bytesOf(news->pictures);
  return news.has_value();
}

bool mayEnd(const Order& order, const Outcome& outcome, const std::optional<SharedBytes>& body,
            const Announced& announced) {
  if (outcome.damaged || !outcome.problems.empty()) return true;
  if (outcome.contentType != resultType(order)) return false;
  const bool wasSent = order.kind == OrderKind::bake && order.mediaType == kEventStream;
  if (wasSent || !body) return wasSent && !body;
  switch (order.kind) {
    case OrderKind::load:
      return isSummaryOf(order.scene, *body);
    case OrderKind::plan:
    case OrderKind::nodes:
      return isJson(*body);
    case OrderKind::evaluation:
    case OrderKind::bake:
      if (outcome.contentType != kJsonType && outcome.contentType != kEventStream) return true;
      return isJson(*body);
    case OrderKind::sequenceFrame:
      return announced.pictureBytes == body->size();
    case OrderKind::frame:
    case OrderKind::bakeFile:
      break; // a file, of which only its client reads a byte
  }
  return !body->empty();
}

} // namespace gnomon
