// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "log.h"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <string>

#include "hooke/base/printable.h"

namespace hooke::cli {

void start_log(bool quiet) {
  auto console = std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
  console->set_level(quiet ? spdlog::level::err : spdlog::level::warn);
  console->set_pattern("%^%l:%$ %v");
  auto logger = std::make_shared<spdlog::logger>("hooke", std::move(console));
  // A log that can't be written (a full disk) must not hide the run's own report of the error.
  logger->set_error_handler([](const std::string&) {});
  spdlog::set_default_logger(std::move(logger));
}

Expected<void> log_to_file(const std::filesystem::path& file) {
  try {
    auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string());
    sink->set_pattern("%Y-%m-%d %H:%M:%S.%e %l: %v");
    spdlog::default_logger()->sinks().push_back(std::move(sink));
    spdlog::default_logger()->flush_on(spdlog::level::info);
    return {};
  } catch (const spdlog::spdlog_ex&) {
    return fail(Error::Kind::io, file.string(), "can't be written");
  }
}

namespace {

// A finding may quote a file: nothing of that may steer the terminal.
std::string shown(const Finding& finding) {
  const std::string text = finding.where.empty() ? finding.message : finding.where + ": " + finding.message;
  return printable(text, text.size());
}

}  // namespace

void report_warning(const Finding& warning) { spdlog::warn(shown(warning)); }

ExitStatus report_error(const Error& error, bool running) {
  for (const Finding& finding : error.findings) {
    spdlog::error(shown(finding));
  }
  switch (error.kind) {
    case Error::Kind::bad_input:
      return kBadInput;
    case Error::Kind::run_failed:
      return kRunFailed;
    case Error::Kind::io:
      break;
  }
  return running ? kRunFailed : kBadInput;
}

}  // namespace hooke::cli
