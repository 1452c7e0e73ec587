#include "protocol/fields/fields.h"

#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <string>

#include "protocol/evaluation/evaluation_rows.h"
#include "protocol/report/reply_rows.h"
#include "protocol/spec/field_rows.h"

namespace gnomon {
namespace {

struct Three {
  int a = 0;
  std::optional<std::vector<std::string>> b;
  std::array<double, 3> c{};
};
static_assert(memberCount<Three>() == 3);
struct None {};
static_assert(memberCount<None>() == 0);

enum class Fruit { apple, pear, plum_ };
static_assert(compilerName<Fruit::pear>() == "pear");
static_assert(compilerName<Fruit::plum_>() == "plum");
static_assert(compilerName<static_cast<Fruit>(3)>().starts_with('('));

enum class Short { one, two };
enum class Wrong { one, two };

} // namespace

template <>
inline constexpr std::array kSpellings<Short>{spelling<Short::one>()};
template <>
inline constexpr std::array kSpellings<Wrong>{spelling<Wrong::two>(), spelling<Wrong::one>()};

namespace {

static_assert(!spellsAll<Short>(), "an enumerator is missing");
static_assert(!spellsAll<Wrong>(), "the enumerators are out of order");

/// Calls `visit` with each row of T and of every struct that T leads to.
template <class T, class Visit>
void forEachRowWithin(const Visit& visit) {
  if constexpr (Described<T>) {
    forEachField<T>([&]<class F>(const F& field) {
      visit(std::string(kRows<T>.name), field);
      forEachRowWithin<typename F::Member>(visit);
    });
  } else if constexpr (requires(T t) {
                         *t;
                         typename T::value_type;
                       }) {
    forEachRowWithin<typename T::value_type>(visit);
  } else if constexpr (requires(T t) { t.begin(); }) {
    forEachRowWithin<typename T::value_type>(visit);
  }
}

template <class T>
constexpr bool isNumeric = std::is_same_v<T, int> || std::is_same_v<T, double> || std::is_same_v<T, Vec3> ||
                           std::is_same_v<T, std::vector<double>>;
template <class T>
constexpr bool isNumeric<std::optional<T>> = isNumeric<T>;
template <class... Kinds>
constexpr bool isNumeric<std::variant<Kinds...>> = true;

TEST(Fields, EveryNumberOfARequestIsBoundedOnBothSides) {
  int count = 0;
  forEachRowWithin<EvaluationRequest>([&]<class F>(const std::string& owner, const F& field) {
    if constexpr (isNumeric<typename F::Member>) {
      ++count;
      EXPECT_TRUE(std::isfinite(field.notes.range.min) && std::isfinite(field.notes.range.max)) << owner << field.name;
    }
  });
  EXPECT_GT(count, 30);
}

TEST(Fields, EveryDefaultLiesWithinItsRow) {
  EXPECT_TRUE(kFrameSideRange.contains(FrameSpec{}.width));
  EXPECT_TRUE(kTexelSides.contains(Atlas{}.size));
  EXPECT_TRUE(kTexelSides.contains(Atlas{}.baseSize));
}

TEST(Fields, EveryRowSaysWhatItIsInASentence) {
  std::set<std::string> names;
  const auto check = [&](const std::string& owner, const auto& field) {
    names.insert(owner + "." + std::string(field.name));
    ASSERT_FALSE(field.notes.says.empty()) << owner << "." << field.name;
    EXPECT_TRUE(field.notes.says.ends_with('.')) << owner << "." << field.name;
  };
  forEachRowWithin<EvaluationRequest>(check);
  forEachRowWithin<EvaluationReport>(check);
  forEachRowWithin<FrameReport>(check);
  forEachRowWithin<SceneList>(check);
  forEachRowWithin<Capabilities>(check);
  for (const char* name : {"FrameSpec.width", "EyeTarget.up", "Sun.elevationDegrees", "Filter.size", "Output.format",
                           "TileReport.tile", "FrameCounts.drawCalls", "CameraSummary.node", "Limits.maxNodes"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
}

TEST(Fields, ARangeKnowsItsEnds) {
  constexpr Range closed{0, 1};
  EXPECT_TRUE(closed.contains(0) && closed.contains(1));
  EXPECT_FALSE(closed.contains(-1e-300) || closed.contains(std::nextafter(1, 2)));
  constexpr Range open{0, 180, true, true};
  EXPECT_TRUE(open.contains(1e-300) && open.contains(179.999));
  EXPECT_FALSE(open.contains(0) || open.contains(180));
  EXPECT_FALSE(closed.contains(std::nan("")) || open.contains(std::nan("")));
}

TEST(Fields, ChoicesArePowersOfTwo) {
  constexpr Choices sides = powersOfTwo(128, 1024);
  EXPECT_EQ(sides.count, 4u);
  EXPECT_TRUE(sides.contains(256));
  EXPECT_FALSE(sides.contains(384) || sides.contains(64) || sides.contains(2048) || sides.contains(0));
}

} // namespace
} // namespace gnomon
