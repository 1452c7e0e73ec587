#include "server/http/router.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

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

TEST(Router, KnowsNothingElse) {
  EXPECT_EQ(patternOf("GET", {"v1"}), "none");
  EXPECT_EQ(patternOf("GET", {"v1", "scenes", ""}), "GET /v1/scenes/{id}");
  EXPECT_EQ(patternOf("GET", {"v1", "scenes", "a", "b"}), "none");
}

} // namespace
} // namespace gnomon
