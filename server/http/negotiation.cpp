#include "server/http/negotiation.h"

#include <algorithm>
#include <string>
#include <vector>

#include "protocol/base/text.h"
#include "server/system/numbers.h"

namespace gnomon {
namespace {

struct MediaRange {
  std::string type;
  int quality = 1000; ///< thousandths
};

/// Thousandths from "0", "0.5", "1.000"; anything else counts as 0, so that it is never chosen by mistake.
int qualityOf(std::string_view text) {
  const auto value = numberIn(text, 0.0, 1.0);
  return value ? static_cast<int>(*value * 1000 + 0.5) : 0;
}

std::vector<MediaRange> rangesOf(std::string_view accept) {
  std::vector<MediaRange> ranges;
  for (const std::string& entry : splitTrimmed(accept, ',')) {
    const std::vector<std::string> parts = splitTrimmed(entry, ';');
    if (parts.empty() || parts.front().empty()) continue;
    MediaRange range{lowerCase(parts.front())};
    for (std::size_t i = 1; i < parts.size(); ++i) {
      const std::string parameter = lowerCase(parts[i]);
      if (parameter.starts_with("q=")) range.quality = qualityOf(std::string_view(parameter).substr(2));
    }
    ranges.push_back(std::move(range));
  }
  return ranges;
}

/// 3 = the type itself, 2 = "image/*", 1 = "*/*", 0 = not covered.
int specificityOf(std::string_view range, std::string_view type) {
  if (range == type) return 3;
  if (range == "*/*") return 1;
  const bool group = range.ends_with("/*") && type.starts_with(range.substr(0, range.size() - 1));
  return group ? 2 : 0;
}

/// How an Accept header rates a media type: by its most specific range that covers the type.
struct Rating {
  int quality = 0;     ///< thousandths; 0 = not acceptable
  int specificity = 0; ///< of that range

  auto operator<=>(const Rating&) const = default;
};

/// Of equals the first; nothing where none is acceptable.
std::optional<std::size_t> highest(std::span<const Rating> ratings) {
  const auto best = std::max_element(ratings.begin(), ratings.end());
  if (best == ratings.end() || best->quality == 0) return std::nullopt;
  return static_cast<std::size_t>(best - ratings.begin());
}

Rating ratingOf(const std::vector<MediaRange>& ranges, std::string_view type) {
  Rating rating;
  for (const MediaRange& range : ranges) {
    const int specific = specificityOf(range.type, type);
    if (specific > rating.specificity) rating = {range.quality, specific};
  }
  return rating;
}

std::string_view withoutWeakness(std::string_view tag) {
  return tag.starts_with("W/") ? tag.substr(2) : tag;
}

} // namespace

std::optional<std::size_t> preferred(std::optional<std::string_view> accept, std::span<const std::string_view> offers) {
  if (!accept || trimmed(*accept).empty()) return 0;
  const std::vector<MediaRange> ranges = rangesOf(*accept);
  std::vector<Rating> ratings;
  for (const std::string_view offer : offers) ratings.push_back(ratingOf(ranges, offer));
  return highest(ratings);
}

Problem notAcceptable(std::string_view what, std::optional<std::string_view> accept,
                      std::span<const std::string_view> offers) {
  std::string all;
  for (const std::string_view offer : offers) {
    all.append(all.empty() ? "" : ", ").append(offer);
  }
  return {ProblemCode::notAcceptable, "", std::string(what) + " can't be sent as any media type that Accept lists.",
          all, asciiExcerpt(accept.value_or(""))};
}

namespace {

/// The spec's own format first, then other pictures, forms with a report, and arrays.
std::vector<FrameForm> formsFor(ImageFormat specFormat) {
  std::vector<FrameForm> forms{{ReplyForm::image, specFormat}};
  const auto add = [&](bool pictures) {
    for (const FormatTraits& traits : kFormatTraits) {
      const bool isPicture = traits.mediaType.starts_with("image/");
      if (traits.format != specFormat && isPicture == pictures) forms.push_back({ReplyForm::image, traits.format});
    }
  };
  add(true);
  forms.push_back({ReplyForm::multipart, specFormat});
  forms.push_back({ReplyForm::json, specFormat});
  add(false);
  return forms;
}

} // namespace

std::optional<FrameForm> negotiate(std::optional<std::string_view> accept, ImageFormat specFormat) {
  const std::vector<FrameForm> forms = formsFor(specFormat);
  if (!accept || trimmed(*accept).empty()) return forms.front();
  const std::vector<MediaRange> ranges = rangesOf(*accept);
  std::vector<Rating> ratings;
  for (const FrameForm form : forms) ratings.push_back(ratingOf(ranges, mediaTypeOf(form)));
  if (ratings.front().quality > 0) {
    for (std::size_t i = 1; i < forms.size(); ++i) {
      const bool listed = forms[i].form == ReplyForm::image && traitsOf(forms[i].format).inBrowsers;
      if (listed) ratings.front() = std::max(ratings.front(), ratings[i]);
    }
  }
  const auto best = highest(ratings);
  return best ? std::optional(forms[*best]) : std::nullopt;
}

namespace {

constexpr std::string_view kAnyTag = "*";

/// Whether a list names the tag; our tags hold no comma.
bool lists(std::string_view list, std::string_view etag, bool isStrong) {
  if (etag.empty() || (isStrong && etag != withoutWeakness(etag))) return false;
  const std::vector<std::string> tags = splitTrimmed(list, ',');
  return std::any_of(tags.begin(), tags.end(), [&](const std::string& tag) {
    return isStrong ? tag == etag : withoutWeakness(tag) == withoutWeakness(etag);
  });
}

} // namespace

Precondition preconditionOf(const Headers& headers, std::string_view etag) {
  const auto match = headerValue(headers, "if-match");
  if (match && trimmed(*match) != kAnyTag && !lists(*match, etag, true)) return Precondition::failed;
  const auto none = headerValue(headers, "if-none-match");
  if (!none) return Precondition::holds;
  if (trimmed(*none) == kAnyTag) return Precondition::exists;
  return lists(*none, etag, false) ? Precondition::known : Precondition::holds;
}

Problem preconditionFailed(const Headers& headers, std::string_view etag) {
  return {ProblemCode::preconditionFailed, "If-Match",
          etag.empty() ? "This has no entity tag, so that If-Match can name none."
                       : "The entity tag is none of those that If-Match lists.",
          std::string(etag), asciiExcerpt(headerValue(headers, "if-match").value_or(""))};
}

} // namespace gnomon
