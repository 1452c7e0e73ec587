#pragma once

#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <span>
#include <string>

#include "tests/support/files.h"

namespace gnomon::testing {

/// Expects `table` between a page's markers <!-- NAME --> and <!-- /NAME -->; GNOMON_README_UPDATE=1 writes it there.
inline void expectTable(const std::filesystem::path& file, const std::string& name, const std::string& table) {
  const Bytes bytes = readFile(file);
  std::string page(bytes.begin(), bytes.end());
  const std::string begin = "<!-- " + name + " -->\n\n";
  const std::size_t at = page.find(begin) + begin.size();
  const std::size_t end = page.find("\n<!-- /" + name + " -->", at);
  ASSERT_TRUE(page.find(begin) != std::string::npos && end != std::string::npos)
      << file << " has lost its markers: " << begin << "...";
  const std::string listed = page.substr(at, end - at);
  if (std::getenv("GNOMON_README_UPDATE") == nullptr) {
    EXPECT_EQ(listed, table) << "GNOMON_README_UPDATE=1 writes it anew";
    return;
  }
  page.replace(at, end - at, table);
  writeFile(file, std::span(reinterpret_cast<const std::uint8_t*>(page.data()), page.size()));
}

} // namespace gnomon::testing
