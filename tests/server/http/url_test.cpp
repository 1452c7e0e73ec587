#include "server/http/url.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "server/http/router.h"

namespace gnomon {
namespace {

using Strings = std::vector<std::string>;

Strings pathOf(std::string_view target) {
  auto url = parseTarget(target);
  return url ? url->path : Strings{"refused"};
}

TEST(Url, CutsThePathIntoSegments) {
  EXPECT_EQ(pathOf("/"), Strings{});
  EXPECT_EQ(pathOf("/v1/scenes"), (Strings{"v1", "scenes"}));
  EXPECT_EQ(pathOf("/v1/scenes/"), (Strings{"v1", "scenes", ""}));
  EXPECT_EQ(pathOf("//a"), (Strings{"", "a"}));
}

TEST(Url, DecodesAfterCutting) {
  EXPECT_EQ(pathOf("/a%2Fb/c%20d"), (Strings{"a/b", "c d"}));
  EXPECT_EQ(pathOf("/a+b"), Strings{"a+b"});
}

TEST(Url, ReadsTheQueryInOrder) {
  const auto url = parseTarget("/f?b=1&a=x+y%26z&b=2&empty=&bare&&e=1=2");
  ASSERT_TRUE(url);
  const std::vector<std::pair<std::string, std::string>> expected{{"b", "1"},    {"a", "x y&z"}, {"b", "2"},
                                                                  {"empty", ""}, {"bare", ""},   {"e", "1=2"}};
  EXPECT_EQ(url->query, expected);
}

TEST(Url, RefusesWhatLies) {
  for (const char* target :
       {"", "v1", "/a/../b", "/%2e%2e/b", "/./b", "/a%", "/a%2", "/a%zz", "/a%00b", "/a?x=%0d%0aSet", "/a?%0a=1"}) {
    const auto url = parseTarget(target);
    ASSERT_FALSE(url) << target;
    EXPECT_EQ(url.problems().front().code, ProblemCode::malformed) << target;
  }
}

TEST(Url, DecodesWhatWasEncoded) {
  EXPECT_TRUE(rc::check([] {
    const auto text = *rc::gen::container<std::string>(rc::gen::inRange<char>(0x20, 0x7f));
    std::string encoded;
    for (const char c : text) {
      constexpr std::string_view kDigits = "0123456789ABCDEF";
      encoded += {'%', kDigits[static_cast<unsigned char>(c) >> 4], kDigits[c & 15]};
    }
    const auto decoded = decodeUrlText(encoded, true);
    RC_ASSERT(static_cast<bool>(decoded));
    RC_ASSERT(*decoded == text);
  }));
}

std::vector<std::string> pointersOf(const Problems& problems) {
  std::vector<std::string> pointers;
  for (const Problem& problem : problems) pointers.push_back(problem.pointer);
  return pointers;
}

TEST(QueryKeys, RefusesWhatIsNotAmongThem) {
  const QueryKeys keys{"limit", "after"};
  EXPECT_TRUE(keys.check({}).empty());
  EXPECT_TRUE(keys.check({{"after", ""}, {"limit", "x"}}).empty()) << "values are the route's";
  const Problems problems = keys.check({{"Limit", "1"}, {"after", "1"}, {"", "2"}, {"after", "3"}});
  EXPECT_EQ(pointersOf(problems), (std::vector<std::string>{"/Limit", "/", "/after"}));
  EXPECT_EQ(problems.at(0).limit, "limit, after");
  EXPECT_EQ(QueryKeys().check({{"v", "1"}}).at(0).limit, "no query");
  EXPECT_TRUE(QueryKeys::any().check({{"v", "1"}, {"v", "2"}}).empty());
}

TEST(QueryKeys, ItsProblemsAreFewerThanAHostileQuerysKeys) {
  EXPECT_EQ(QueryKeys().check(Query(10'000, {"x", ""})).size(), ProblemList::kMax + 1);
}

TEST(Query, GivesAKeysTextOrNothing) {
  const Query query{{"a", "1"}, {"b", ""}};
  EXPECT_EQ(queryText(query, "a"), "1");
  EXPECT_EQ(queryText(query, "b"), "");
  EXPECT_EQ(queryText(query, "c"), std::nullopt);
}

TEST(Query, ANumberIsDigitsWithinItsRange) {
  const auto asked = [](const char* text) { return queryNumber({{"n", text}}, "n", 1, 20, "This is no n."); };
  EXPECT_EQ(*asked("1"), 1);
  EXPECT_EQ(*asked("20"), 20);
  EXPECT_EQ(*queryNumber({{"m", "1"}}, "n", 1, 20, ""), std::nullopt);
  for (const char* wrong : {"", "0", "21", "-1", "+1", " 1", "1 ", "1.0", "0x1", "99999999999999999999", "one"}) {
    const auto refused = asked(wrong);
    ASSERT_FALSE(refused) << wrong;
    EXPECT_EQ(refused.problems()[0].pointer, "/n");
    EXPECT_EQ(refused.problems()[0].detail, "This is no n.");
    EXPECT_EQ(refused.problems()[0].limit, "1..20");
    EXPECT_EQ(refused.problems()[0].actual, wrong);
  }
}

Route route(std::string method, std::string pattern) {
  return {std::move(method), std::move(pattern), Scope::none, {}, {}, {}};
}

Router testRouter() {
  return Router({route("GET", "/"), route("GET", "/v1/scenes"), route("POST", "/v1/scenes"),
                 route("GET", "/v1/scenes/{id}"), route("DELETE", "/v1/scenes/{id}"),
                 route("GET", "/v1/scenes/special"), route("POST", "/v1/scenes/{id}/frames")});
}

std::string patternOf(std::string_view method, const std::vector<std::string>& path) {
  const Router router = testRouter();
  const auto found = router.find(method, path);
  if (const auto* match = std::get_if<RouteMatch>(&found)) {
    return match->route->method + " " + match->route->pattern;
  }
  const auto* refused = std::get_if<MethodRefused>(&found);
  return refused ? "allow " + refused->allow : "none";
}

TEST(Router, FindsByMethodAndSegments) {
  EXPECT_EQ(patternOf("GET", {}), "GET /");
  EXPECT_EQ(patternOf("GET", {"v1", "scenes"}), "GET /v1/scenes");
  EXPECT_EQ(patternOf("POST", {"v1", "scenes"}), "POST /v1/scenes");
  EXPECT_EQ(patternOf("POST", {"v1", "scenes", "x", "frames"}), "POST /v1/scenes/{id}/frames");
}

TEST(Router, GivesTheNamedSegments) {
  const Router router = testRouter();
  const auto found = router.find("DELETE", {"v1", "scenes", "abc"});
  ASSERT_TRUE(std::holds_alternative<RouteMatch>(found));
  EXPECT_EQ(std::get<RouteMatch>(found).values, (PathValues{{"id", "abc"}}));
}

TEST(Router, PrefersLiteralSegments) {
  EXPECT_EQ(patternOf("GET", {"v1", "scenes", "special"}), "GET /v1/scenes/special");
  EXPECT_EQ(patternOf("DELETE", {"v1", "scenes", "special"}), "DELETE /v1/scenes/{id}");
}

TEST(Router, AnswersHeadByGet) {
  EXPECT_EQ(patternOf("HEAD", {"v1", "scenes"}), "GET /v1/scenes");
}

TEST(Router, NamesTheMethodsThatThereAre) {
  EXPECT_EQ(patternOf("PATCH", {"v1", "scenes"}), "allow GET, HEAD, OPTIONS, POST");
  EXPECT_EQ(patternOf("GET", {"v1", "scenes", "x", "frames"}), "allow OPTIONS, POST");
  EXPECT_EQ(patternOf("get", {"v1", "scenes", "x", "frames"}), "allow OPTIONS, POST");
}

TEST(Router, NamesTheMethodsOfAllPaths) {
  EXPECT_EQ(testRouter().allow(), "DELETE, GET, HEAD, OPTIONS, POST");
}

TEST(Router, KnowsNothingElse) {
  EXPECT_EQ(patternOf("GET", {"v1"}), "none");
  EXPECT_EQ(patternOf("GET", {"v1", "scenes", ""}), "GET /v1/scenes/{id}");
  EXPECT_EQ(patternOf("GET", {"v1", "scenes", "a", "b"}), "none");
}

} // namespace
} // namespace gnomon
