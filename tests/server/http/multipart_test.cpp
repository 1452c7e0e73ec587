#include "server/http/multipart.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace gnomon {
namespace {

std::string part(const std::string& disposition, const std::string& content) {
  return "--B\r\nContent-Disposition: form-data; " + disposition + "\r\n\r\n" + content + "\r\n";
}

TEST(Multipart, ReadsTheBoundary) {
  EXPECT_EQ(boundaryOf("multipart/form-data; boundary=abc"), "abc");
  EXPECT_EQ(boundaryOf("multipart/form-data; charset=x; Boundary=\"a b:c\""), "a b:c");
  EXPECT_FALSE(boundaryOf("multipart/form-data"));
  EXPECT_FALSE(boundaryOf("multipart/form-data; boundary="));
  EXPECT_FALSE(boundaryOf("multipart/form-data; boundary=" + std::string(71, 'a')));
  EXPECT_FALSE(boundaryOf("multipart/form-data; boundary=\"a\r\nb\""));
  EXPECT_FALSE(boundaryOf("multipart/form-data; boundary=\"abc"));
}

TEST(Multipart, ReadsParts) {
  const std::string body = part("name=\"a\"", "1\r\n2") + part("name=\"b c\"; filename=\"d\\\"e%22.bin\"", "--B") +
                           "--B\r\nCONTENT-TYPE: text/x\r\ncontent-disposition: form-data; name=c\r\n\r\n\r\n--B--\r\n";
  const auto parts = parseMultipart(body, "B", 3);
  ASSERT_TRUE(parts);
  ASSERT_EQ(parts->size(), 3u);
  EXPECT_EQ((*parts)[0].name, "a");
  EXPECT_EQ((*parts)[0].content, "1\r\n2");
  EXPECT_FALSE((*parts)[0].fileName);
  EXPECT_EQ((*parts)[1].name, "b c");
  EXPECT_EQ((*parts)[1].fileName, "d\"e\".bin");
  EXPECT_EQ((*parts)[1].content, "--B");
  EXPECT_EQ((*parts)[2].contentType, "text/x");
  EXPECT_EQ((*parts)[2].content, "");
}

TEST(Multipart, RefusesWhatIsBroken) {
  for (const std::string& body :
       {std::string(), std::string("--B"), std::string("--A--\r\n"), part("name=a", "x"), part("name=a", "x") + "--B",
        part("name=a", "x") + "--Bx--", part("filename=a", "x") + "--B--", part("name=a; name=b", "x") + "--B--",
        part("name=a; size=3", "x") + "--B--", part("name=\"a", "x") + "--B--", part("name=", "x") + "--B--",
        part("name=a", "x") + "--B--\r\nmore", std::string("--B\r\n\r\nx\r\n--B--"),
        std::string("--B\r\nContent-Disposition: attachment; name=a\r\n\r\nx\r\n--B--"),
        std::string(
            "--B\r\nContent-Disposition: form-data; name=a\r\nContent-Disposition: form-data; name=b\r\n\r\nx\r\n"
            "--B--"),
        std::string("--B\r\nContent-Disposition: form-data; name=a\r\nContent-Transfer-Encoding: base64\r\n\r\nx\r\n"
                    "--B--"),
        std::string("--B\r\nContent-Disposition: form-data; name=a")}) {
    const auto parts = parseMultipart(body, "B", 8);
    ASSERT_FALSE(parts) << body;
    EXPECT_EQ(parts.problems().front().code, ProblemCode::malformed) << body;
  }
}

TEST(Multipart, BoundsTheParts) {
  const auto parts = parseMultipart(part("name=a", "") + part("name=b", "") + "--B--", "B", 1);
  ASSERT_FALSE(parts);
  EXPECT_EQ(parts.problems().front().code, ProblemCode::tooLarge);
}

TEST(Multipart, SurvivesAnything) {
  EXPECT_TRUE(rc::check([](const std::string& a, const std::string& b) {
    const std::string body = "--B\r\nContent-Disposition: form-data; name=" + a + "\r\n\r\n" + b + "\r\n--B--";
    const auto parts = parseMultipart(body, "B", 4);
    if (parts) {
      RC_ASSERT(!parts->empty());
    }
  }));
}

} // namespace
} // namespace gnomon
