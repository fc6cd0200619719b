// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "program.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>

namespace hooke::test {
namespace {

std::string slurp(const std::filesystem::path& file) {
  const std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

void redirect(const std::filesystem::path& file, int descriptor) {
  const int to = open(file.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0644);
  if (to < 0 || dup2(to, descriptor) < 0) _exit(127);
  close(to);
}

}  // namespace

std::string program_file() { return HOOKE_PROGRAM; }
std::string faults_library() { return HOOKE_FAULTS; }

Program::Program(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
                 std::uint64_t file_size_limit, const std::vector<std::string>& environment,
                 const std::string& program) {
  static std::atomic<int> count{0};
  const std::string name = "call" + std::to_string(count++);
  out_ = folder / (name + ".out");
  err_ = folder / (name + ".err");
  std::vector<const char*> argv{program.c_str()};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  argv.push_back(nullptr);

  pid_ = fork();
  setpgid(pid_, pid_);  // parent and child both call it: it is done before either goes on
  if (pid_ != 0) return;
  if (chdir(folder.c_str()) != 0) _exit(127);
  redirect(out_, STDOUT_FILENO);
  redirect(err_, STDERR_FILENO);
  if (file_size_limit > 0) {
    const rlimit limit{file_size_limit, file_size_limit};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  for (const std::string& entry : environment) putenv(const_cast<char*>(entry.c_str()));
  execv(program.c_str(), const_cast<char* const*>(argv.data()));
  _exit(127);
}

Outcome Program::wait() {
  int status = 0;
  waitpid(pid_, &status, 0);
  return {WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status), slurp(out_), slurp(err_)};
}

void Program::send(int signal) const { kill(-pid_, signal); }
void Program::send_to_itself(int signal) const { kill(pid_, signal); }

std::vector<pid_t> Program::children() const {
  const std::string id = std::to_string(pid_);
  std::ifstream list("/proc/" + id + "/task/" + id + "/children");
  std::vector<pid_t> all;
  for (pid_t child = 0; list >> child;) all.push_back(child);
  return all;
}

ProgramTest::ProgramTest() {
  std::string pattern = (std::filesystem::temp_directory_path() / "hooke_cli_XXXXXX").string();
  folder_ = mkdtemp(pattern.data());
}

ProgramTest::~ProgramTest() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

void ProgramTest::write(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
}

std::string ProgramTest::read(const std::string& name) const { return slurp(path(name)); }

Program ProgramTest::start(const std::vector<std::string>& arguments, std::uint64_t file_size_limit) const {
  return {folder_, arguments, file_size_limit};
}

Program ProgramTest::start_other(const std::string& program, const std::vector<std::string>& arguments) const {
  return {folder_, arguments, 0, {}, program};
}

Outcome ProgramTest::hooke(const std::vector<std::string>& arguments, std::uint64_t file_size_limit) const {
  return start(arguments, file_size_limit).wait();
}

Outcome ProgramTest::hooke(const std::vector<std::string>& arguments,
                           const std::vector<std::string>& environment) const {
  return Program(folder_, arguments, 0, environment).wait();
}

std::string ProgramTest::hooke_ok(const std::vector<std::string>& arguments) const {
  const Outcome outcome = hooke(arguments);
  EXPECT_EQ(outcome.status, 0) << arguments.front() << ": " << outcome.err;
  return outcome.out;
}

std::string ProgramTest::export_all(const std::string& run) const {
  const std::string file = "all_" + std::filesystem::path(run).filename().string() + ".csv";
  hooke_ok({"export", run, "--all", "-o", file});
  return read(file);
}

std::string ProgramTest::state_hash(const std::string& run) const {
  const std::string report = read(run + "/report.json");
  const std::string key = "\"state_hash\": \"";
  const std::size_t at = report.find(key);
  return at == std::string::npos ? "none in " + report : report.substr(at + key.size(), 16);
}

bool ProgramTest::wait_until(const std::function<bool()>& holds) {
  for (int i = 0; i < 3000; ++i) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

std::string pool_scene(int side, const std::string& integrator, const std::string& precision) {
  const std::string room = std::to_string(0.5 * side + 1);
  const std::string top = std::to_string(0.3 + 0.4 * (side - 1));
  return R"({
  "hooke": 1, "name": "small pool", // a comment
  "time": { "step": 0.005, "steps": 60, "integrator": ")" +
         integrator + R"(" },
  "precision": ")" +
         precision + R"(",
  "domain": { "min": [0, 0, 0], "max": [)" +
         room + ", " + room + ", " + room + R"(] },
  "materials": { "water": { "radius": 0.2, "mass": 1, "stiffness": 6000, "shear": 2, "damping": 8 } },
  "particles": [ { "material": "water",
                   "block": { "min": [0.3, 0.3, 0.3], "max": [)" +
         top + ", " + top + ", " + top + R"(],
                              "spacing": 0.4, "lattice": "cubic", "jitter": 0.01, "seed": 3 } } ],
  "output": { "every_steps": 7 }
})";
}

}  // namespace hooke::test
