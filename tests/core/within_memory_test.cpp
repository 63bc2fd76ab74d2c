#include "relievo/core/within_memory.h"

#include <limits>
#include <vector>

#include "relievo/core/parallel.h"
#include "support/results.h"

namespace relievo {
namespace {

TEST(WithinMemory, PassesOnWhatIsReturned) {
  EXPECT_EQ(within_memory([]() -> Result<int> { return 5; }), 5);
  const auto refuse = []() -> Result<int> { return option_error("height", "expected 1"); };
  EXPECT_EQ(message_of(within_memory(refuse)), "height: expected 1");
}

TEST(WithinMemory, NamesWhatIsKnownOfTheNeed) {
  const auto message = [](const MemoryNeed& need) { return memory_error(need).message(); };
  EXPECT_EQ(message({}), "expected more free memory, found none left");
  EXPECT_EQ(message({.points = 12000}), "expected more free memory for 12000 points, found none left");
  EXPECT_EQ(message({12000, .01}),
            "expected more free memory for 12000 points at a resolution of 0.01 mm, found none left");
  EXPECT_EQ(name_of(memory_error().kind), "memory");
}

TEST(WithinMemory, IsAnErrorOfTheInnermostCall) {
  const auto failed = within_memory({.points = 5}, [] {
    return within_memory({.points = 7}, []() -> Result<void> { throw std::bad_alloc(); });
  });
  EXPECT_EQ(message_of(failed), memory_error({.points = 7}).message());
}

// The first size is more than std::vector allows. The second size is allowed, but no machine has so much memory.
TEST(WithinMemory, AnswersWhatNoMachineHas) {
  for (const std::size_t size : {std::numeric_limits<std::size_t>::max(), std::size_t{1} << 55})
    for (const int threads : {1, 2}) {
      set_thread_count(threads);
      const auto failed = within_memory([&]() -> Result<std::size_t> {
        std::vector<std::vector<double>> all(8);
        parallel_for(
            8, [&](std::size_t i) { all[i].reserve(i == 6 ? size : 10); }, 1);
        return all[6].capacity();
      });
      set_thread_count(0);
      expect_error(failed, ErrorKind::memory);
    }
}

}  // namespace
}  // namespace relievo
