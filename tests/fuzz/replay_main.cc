// NAME_fuzz SECONDS FOLDER...
//
// Runs a fuzz target once on every file in the folders, so that faults found earlier stay fixed; then, for SECONDS, on
// mutations of these files: always the same sequence, as far as the time allows. For compilers without libFuzzer. A
// missing folder counts as empty. An input on which the target fails is written to `failed_input` in the working
// directory.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <optional>
#include <random>
#include <string>
#include <vector>

// What libFuzzer takes of a target, and what it gives to one, in fuzz_target.cc.
extern "C" {
int LLVMFuzzerInitialize(int* argument_count, char*** arguments);
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned int seed);
std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);
}

namespace {

constexpr unsigned int kSeed = 1;
// Values at which lengths, counts and offsets tend to fail.
constexpr std::uint32_t kBoundaryValues[] = {0,      1,      0x7f,       0x80,       0xff,
                                             0x7fff, 0xffff, 0x7fffffff, 0x80000000, 0xffffffff};

// Mutates inputs byte by byte, like libFuzzer but without coverage feedback. Equal inputs and seeds give equal
// mutations.
class Mutator {
 public:
  Mutator(std::vector<std::string> inputs, unsigned int seed) : inputs_(std::move(inputs)), random_(seed) {}

  const std::string& AnyInput() { return inputs_[Below(inputs_.size())]; }

  // `input` with one to four changes, truncated to `most` bytes.
  std::string Mutate(std::string input, std::size_t most) {
    for (std::size_t i = 0, changes = 1 + Below(4); i < changes; ++i) ChangeOnce(input);
    input.resize(std::min(input.size(), most));
    return input;
  }

  unsigned int Number() { return static_cast<unsigned int>(random_()); }

 private:
  std::size_t Below(std::size_t end) { return random_() % end; }

  void ChangeOnce(std::string& input) {
    const std::size_t begin = Below(input.size() + 1),
                      size = Below(std::min<std::size_t>(input.size() - begin, 32) + 1);
    switch (Below(6)) {
      case 0:
        input.erase(begin, size);
        return;
      case 1:
        input.insert(begin, std::string(input, begin, size));
        return;
      case 2:
        input.insert(begin, 1 + Below(8), static_cast<char>(Below(256)));
        return;
      case 3: {  // A piece of another input.
        const std::string& other = inputs_[Below(inputs_.size())];
        input.replace(begin, size, other, Below(other.size() + 1), Below(64));
        return;
      }
      case 4: {
        const std::uint32_t number = kBoundaryValues[Below(std::size(kBoundaryValues))];
        const std::size_t bytes = std::min(input.size() - begin, std::size_t{1} << Below(3));
        std::memcpy(input.data() + begin, &number, bytes);
        return;
      }
      default:
        if (begin < input.size()) input[begin] = static_cast<char>(input[begin] ^ 1 << Below(8));
    }
  }

  const std::vector<std::string> inputs_;  // Not empty.
  std::mt19937 random_;
};

std::optional<Mutator> mutator;
std::vector<std::uint8_t> input;  // That the target is running on.

// A signal handler: calls only async-signal-safe functions.
extern "C" void LeaveInput(int signal) {
  const int file = open("failed_input", O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (write(file, input.data(), input.size()) < 0) _exit(1);
  std::signal(signal, SIG_DFL);
  raise(signal);
}

std::vector<std::string> ReadInputs(const std::vector<std::filesystem::path>& folders) {
  std::vector<std::string> inputs;
  for (const std::filesystem::path& folder : folders) {
    if (!std::filesystem::is_directory(folder)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      if (!entry.is_regular_file()) continue;
      std::ifstream file(entry.path(), std::ios::binary);
      inputs.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    }
  }
  std::sort(inputs.begin(), inputs.end());  // Directory entries come in any order.
  return inputs;
}

void Try(const std::string& bytes) {
  input = std::vector<std::uint8_t>(bytes.begin(), bytes.end());  // Of its size: sanitizers detect reads beyond it.
  LLVMFuzzerTestOneInput(input.data(), input.size());
}

std::string NewInput(std::size_t most) {
  std::string bytes = mutator->AnyInput();
  const std::size_t size = bytes.size();
  bytes.resize(most);
  bytes.resize(LLVMFuzzerCustomMutator(reinterpret_cast<std::uint8_t*>(bytes.data()), size, most, mutator->Number()));
  return bytes;
}

}  // namespace

std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size) {
  const std::string bytes = mutator->Mutate(std::string(data, data + size), max_size);
  std::copy(bytes.begin(), bytes.end(), data);
  return bytes.size();
}

int main(int argc, char** argv) {
  using Clock = std::chrono::steady_clock;
  if (argc < 3) return 2;
  LLVMFuzzerInitialize(&argc, &argv);
  const std::chrono::duration<double> time(std::stod(argv[1]));
  const std::vector<std::string> inputs = ReadInputs({argv + 2, argv + argc});
  if (inputs.empty()) return 1;
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE}) std::signal(signal, LeaveInput);
  std::size_t longest = 64;
  for (const std::string& each : inputs) {
    Try(each);
    longest = std::max(longest, each.size());
  }
  mutator.emplace(inputs, kSeed);
  std::size_t made = 0;
  for (const auto end = Clock::now() + time; Clock::now() < end; ++made) Try(NewInput(2 * longest));
  std::cout << inputs.size() << " inputs, " << made << " mutations of them\n";
}
