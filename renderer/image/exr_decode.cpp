#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <limits>
#include <map>
#include <new>
#include <string_view>
#include <utility>

#include "renderer/image/image_codec.h"

namespace gnomon {
namespace {

constexpr std::array<std::uint8_t, 4> kMagic{0x76, 0x2f, 0x31, 0x01};

class MemorySource : public Imf::IStream {
 public:
  explicit MemorySource(std::span<const std::uint8_t> bytes) : Imf::IStream("memory"), bytes_(bytes) {}

  bool read(char into[], int count) override {
    const auto size = static_cast<std::uint64_t>(std::max(count, 0));
    if (at_ > bytes_.size() || size > bytes_.size() - at_) throw Iex::InputExc("it ends too early");
    std::memcpy(into, bytes_.data() + at_, size);
    at_ += size;
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t position) override { at_ = position; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::uint64_t at_ = 0;
};

Problem exrProblem(ProblemCode code, std::string detail, std::string limit = "", std::string actual = "") {
  return {code, "", std::move(detail), std::move(limit), std::move(actual)};
}

/// Width and height of a part.
Result<std::array<std::int64_t, 2>> sizeOf(const Imf::Header& header, int maxSide) {
  const Imath::Box2i& window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  if (width < 1 || height < 1 || width > maxSide || height > maxSide) {
    return exrProblem(ProblemCode::tooLarge, "The EXR is too large.", std::to_string(maxSide) + " pixels a side",
                      std::to_string(width) + "x" + std::to_string(height));
  }
  return std::array{width, height};
}

/// "depth.Z" -> "depth"; "Z" -> `unnamed`.
std::string layerOf(const std::string& channel, const std::string& unnamed) {
  const auto dot = channel.rfind('.');
  return dot == std::string::npos ? unnamed : channel.substr(0, dot);
}

std::string unnamedLayer(const Imf::Header& header) {
  for (auto each = header.channels().begin(); each != header.channels().end(); ++each) {
    if (std::string_view(each.name()).find('.') != std::string_view::npos) return "main";
  }
  return header.hasName() && !header.name().empty() ? header.name() : "main";
}

/// Red first, then by name.
void sortChannels(std::vector<std::string>& names) {
  const auto rank = [](const std::string& name) {
    constexpr std::string_view kColors = "RGBA";
    const auto found = name.size() == 1 ? kColors.find(name[0]) : std::string_view::npos;
    return found == std::string_view::npos ? kColors.size() : found;
  };
  std::sort(names.begin(), names.end(),
            [&](const std::string& a, const std::string& b) { return std::pair(rank(a), a) < std::pair(rank(b), b); });
}

/// The layers of a part, without pixels, and where each of its channels goes.
struct PartPlan {
  std::vector<ExrLayer> layers;
  std::map<std::string, std::pair<std::size_t, std::string>> places; ///< full name -> layer, channel
};

Result<PartPlan> planOf(const Imf::Header& header, const std::array<std::int64_t, 2>& size) {
  const std::string unnamed = unnamedLayer(header);
  PartPlan plan;
  for (auto each = header.channels().begin(); each != header.channels().end(); ++each) {
    if (each.channel().xSampling != 1 || each.channel().ySampling != 1) {
      return exrProblem(ProblemCode::unsupportedFeature, "A channel of the EXR has fewer pixels than its part.",
                        "a sample a pixel", each.name());
    }
    const std::string name = each.name(), layer = layerOf(name, unnamed);
    const auto known = std::find_if(plan.layers.begin(), plan.layers.end(),
                                    [&](const ExrLayer& other) { return other.name == layer; });
    const auto index = static_cast<std::size_t>(known - plan.layers.begin());
    if (known == plan.layers.end()) {
      plan.layers.push_back({layer, {static_cast<int>(size[0]), static_cast<int>(size[1]), {}, {}}});
    }
    const auto dot = name.rfind('.');
    const std::string channel = dot == std::string::npos ? name : name.substr(dot + 1);
    plan.layers[index].image.channels.push_back(channel);
    plan.places[name] = {index, channel};
  }
  for (ExrLayer& layer : plan.layers) sortChannels(layer.image.channels);
  return plan;
}

/// Reads the pixels of a part that was planned.
std::vector<ExrLayer> readPart(Imf::MultiPartInputFile& file, int index, PartPlan plan) {
  Imf::InputPart part(file, index);
  const Imath::Box2i& window = part.header().dataWindow();
  Imf::FrameBuffer target;
  for (ExrLayer& layer : plan.layers) {
    const auto pixels = static_cast<std::size_t>(layer.image.width) * static_cast<std::size_t>(layer.image.height);
    layer.image.pixels = std::vector<float>(pixels * layer.image.channels.size());
  }
  for (const auto& [name, place] : plan.places) {
    Image& image = plan.layers[place.first].image;
    const auto found = std::find(image.channels.begin(), image.channels.end(), place.second);
    const std::size_t step = sizeof(float) * image.channels.size();
    auto* first = std::get<std::vector<float>>(image.pixels).data() + (found - image.channels.begin());
    target.insert(name,
                  Imf::Slice::Make(Imf::FLOAT, first, window, step, step * static_cast<std::size_t>(image.width)));
  }
  part.setFrameBuffer(target);
  part.readPixels(window.min.y, window.max.y);
  return std::move(plan.layers);
}

Result<std::vector<ExrLayer>> readParts(Imf::MultiPartInputFile& file, int maxSide, std::int64_t maxValues) {
  std::vector<ExrLayer> layers;
  std::int64_t values = 0;
  for (int i = 0; i < file.parts(); ++i) {
    const Imf::Header& header = file.header(i);
    if (header.hasType() && Imf::isDeepData(header.type())) {
      return exrProblem(ProblemCode::unsupportedFeature, "The EXR is deep: its pixels have samples of many depths.");
    }
    const auto size = sizeOf(header, maxSide);
    if (!size) return size.problems();
    auto plan = planOf(header, *size);
    if (!plan) return plan.problems();
    values += (*size)[0] * (*size)[1] * static_cast<std::int64_t>(plan->places.size());
    if (values > maxValues) {
      return exrProblem(ProblemCode::tooLarge, "The EXR holds too many numbers.", std::to_string(maxValues),
                        std::to_string(values) + " or more");
    }
    for (ExrLayer& layer : readPart(file, i, *std::move(plan))) {
      const bool isTaken =
          std::any_of(layers.begin(), layers.end(), [&](const ExrLayer& other) { return other.name == layer.name; });
      if (isTaken) return exrProblem(ProblemCode::invalidValue, "Two layers of the EXR have one name.", "", layer.name);
      layers.push_back(std::move(layer));
    }
  }
  return layers;
}

/// The colors of one part: the full names of its channels.
struct ColorPart {
  int part = 0;
  std::array<std::int64_t, 2> size{};
  std::array<std::string, 3> channels; ///< all the same where it is grey
};

Result<ColorPart> colorPart(const Imf::MultiPartInputFile& file, int maxSide) {
  for (int i = 0; i < file.parts(); ++i) {
    const Imf::Header& header = file.header(i);
    if (header.hasType() && Imf::isDeepData(header.type())) continue;
    const auto size = sizeOf(header, maxSide);
    if (!size) return size.problems();
    const auto plan = planOf(header, *size);
    if (!plan) return plan.problems();
    for (std::size_t layer = 0; layer < plan->layers.size(); ++layer) {
      const auto nameOf = [&](const std::string& channel) {
        const auto found = std::find_if(plan->places.begin(), plan->places.end(),
                                        [&](const auto& place) { return place.second == std::pair(layer, channel); });
        return found == plan->places.end() ? std::string() : found->first;
      };
      const std::string grey = nameOf("Y");
      ColorPart colors{i, *size, {nameOf("R"), nameOf("G"), nameOf("B")}};
      if (std::find(colors.channels.begin(), colors.channels.end(), "") == colors.channels.end()) return colors;
      if (!grey.empty()) return ColorPart{i, *size, {grey, grey, grey}};
    }
  }
  return exrProblem(ProblemCode::unsupportedFeature, "The EXR has no layer with colors.", "channels R, G and B, or Y");
}

ImageSize sizeOf(const ColorPart& colors) {
  return {static_cast<int>(colors.size[0]), static_cast<int>(colors.size[1])};
}

void readColors(Imf::MultiPartInputFile& file, const ColorPart& colors, std::span<float> pixels) {
  Imf::InputPart part(file, colors.part);
  const Imath::Box2i& window = part.header().dataWindow();
  const bool grey = colors.channels[0] == colors.channels[1];
  constexpr std::size_t kStep = 3 * sizeof(float);
  Imf::FrameBuffer target;
  for (std::size_t i = 0; i < (grey ? 1 : 3); ++i) {
    target.insert(colors.channels[i], Imf::Slice::Make(Imf::FLOAT, pixels.data() + i, window, kStep,
                                                       kStep * static_cast<std::size_t>(colors.size[0])));
  }
  part.setFrameBuffer(target);
  part.readPixels(window.min.y, window.max.y);
  for (std::size_t i = 0; grey && i < pixels.size(); i += 3) pixels[i + 1] = pixels[i + 2] = pixels[i];
}

/// What `read` makes of the file; a problem instead of what OpenEXR throws.
template <class Read>
auto readExrFile(std::span<const std::uint8_t> bytes, const Read& read)
    -> decltype(read(std::declval<Imf::MultiPartInputFile&>())) {
  if (!isExr(bytes)) return exrProblem(ProblemCode::invalidValue, "This is no EXR.");
  try {
    MemorySource source(bytes);
    Imf::MultiPartInputFile file(source);
    return read(file);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return exrProblem(ProblemCode::invalidValue, std::string("The EXR can't be read: ") + error.what() + ".");
  }
}

} // namespace

bool isExr(std::span<const std::uint8_t> file) {
  return file.size() >= kMagic.size() && std::equal(kMagic.begin(), kMagic.end(), file.begin());
}

Result<std::vector<ExrLayer>> decodeExr(std::span<const std::uint8_t> file, int maxSide, std::int64_t maxValues) {
  return readExrFile(file, [&](Imf::MultiPartInputFile& parts) { return readParts(parts, maxSide, maxValues); });
}

Result<ImageSize> exrColorSize(std::span<const std::uint8_t> file) {
  return readExrFile(file, [](const Imf::MultiPartInputFile& parts) -> Result<ImageSize> {
    const auto colors = colorPart(parts, std::numeric_limits<int>::max());
    if (!colors) return colors.problems();
    return sizeOf(*colors);
  });
}

Status decodeExrColor(std::span<const std::uint8_t> file, int maxSide, const RoomForColors& roomFor) {
  return readExrFile(file, [&](Imf::MultiPartInputFile& parts) -> Status {
    const auto colors = colorPart(parts, maxSide);
    if (!colors) return colors.problems();
    readColors(parts, *colors, roomFor(sizeOf(*colors)));
    return Done{};
  });
}

} // namespace gnomon
