#include "service/server/observe/log.h"

#include <gmock/gmock.h>
#include <spdlog/sinks/ostream_sink.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "service/server/ground/limits.h"

namespace albtpu::server {
namespace {

using ::testing::MatchesRegex;

// Captures all lines that are logged during its life.
class LogLines {
 public:
  explicit LogLines(LogStyle style) : before_(spdlog::default_logger()) {
    auto logger = std::make_shared<spdlog::logger>("program", std::make_shared<spdlog::sinks::ostream_sink_st>(text_));
    logger->set_formatter(MakeLogFormatter(style));
    spdlog::set_default_logger(logger);
  }
  ~LogLines() { spdlog::set_default_logger(before_); }

  std::string text() const { return text_.str(); }

  std::vector<nlohmann::json> json() const {
    std::vector<nlohmann::json> lines;
    std::istringstream text(text_.str());
    for (std::string line; std::getline(text, line);) lines.push_back(nlohmann::json::parse(line));
    return lines;
  }

 private:
  std::shared_ptr<spdlog::logger> before_;
  std::ostringstream text_;
};

TEST(Log, WritesPlainText) {
  const LogLines lines(LogStyle::kText);
  spdlog::info("ready");
  Log(spdlog::level::info, "tables reloaded", {{"loaded", 2}, {"name", "survey"}});
  spdlog::info("done");
  EXPECT_EQ(lines.text(), "program: ready\nprogram: tables reloaded [loaded=2 name=survey]\nprogram: done\n");
}

TEST(Log, WritesOneLinePerMessageEvenIfTheMessageHasLineBreaks) {
  const LogLines lines(LogStyle::kText);
  spdlog::info("there is no 'a\nprogram: all is well'");
  EXPECT_EQ(lines.text(), "program: there is no 'a program: all is well'\n");
}

TEST(Log, CutsLinesToTheLengthThatAPipeTakesAtOnce) {
  for (const LogStyle style : {LogStyle::kText, LogStyle::kJson}) {
    const LogLines lines(style);
    Log(spdlog::level::info, std::string(100'000, '\x1b'), {{"name", "a"}});
    EXPECT_LE(lines.text().size(), 4096u);
    EXPECT_GT(lines.text().size(), 1000u);
    EXPECT_TRUE(lines.text().ends_with("\n"));
    EXPECT_NE(lines.text().find(" ..."), std::string::npos);
  }
}

TEST(Log, ReplacesControlCharacters) {
  const LogLines lines(LogStyle::kText);
  Log(spdlog::level::info, "there is no '\x1b[2J\xff\xc2\x9b'", {{"name", "a\x07"}});
  EXPECT_EQ(lines.text(), "program: there is no ' [2J\xef\xbf\xbd ' [name=a ]\n");
}

TEST(Log, WritesJson) {
  const LogLines lines(LogStyle::kJson);
  Log(spdlog::level::warn, "a \"quoted\"\nword, and \xff", {{"seconds", 0.5}});
  const std::vector<nlohmann::json> json = lines.json();
  ASSERT_EQ(json.size(), 1u);
  EXPECT_THAT(json[0].at("time").get<std::string>(),
              MatchesRegex("[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}\\.[0-9]{3}Z"));
  EXPECT_EQ(json[0].at("level"), "warning");
  EXPECT_EQ(json[0].at("message"), "a \"quoted\"\nword, and \xef\xbf\xbd");
  EXPECT_EQ(json[0].at("seconds"), 0.5);
}

}  // namespace
}  // namespace albtpu::server
