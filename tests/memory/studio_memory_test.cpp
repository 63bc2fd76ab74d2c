// Tests the studio, without HTTP and in one process, while memory runs out. If an allocation fails in any thread, the
// request must get its usual answer or an error of kind memory. Nothing may stay busy, and the same request must get
// its usual answer afterwards. Each request is repeated several times, each time with another failing allocation. The
// environment variable ALLOCATIONS is the number of repetitions; 0 means one for every allocation. Allocations of a few
// bytes do not fail here: the destructors of JSON objects make some, and the program keeps a reserve for these.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "memory/failing_allocation.h"
#include "relievo/core/parallel.h"
#include "relievo/core/within_memory.h"
#include "relievo/io/write.h"
#include "relievo/samples/sample.h"
#include "studio/actions.h"
#include "studio/disk/disk_store.h"

namespace relievo::app::studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using test::FailingAllocation;

// The answer to a request. If memory ran out, the text is "memory".
struct Told {
  int status = 0;
  std::string text;
  bool operator==(const Told&) const = default;
};

const Told out_of_memory{507, "memory"};

constexpr std::size_t few_bytes = 4096;

// Returns the text of an answer without times and counts, which differ from one answer to the next.
std::string without_times(const Answer& answer) {
  std::string text = answer.body;
  for (const auto& [name, value] : answer.headers) {
    Json about = Json::parse(value, nullptr, false);
    for (const char* key : {"solves", "heights_ms", "after_solve_ms", "normals_ms", "drawing_ms"})
      if (about.is_object()) about.erase(key);
    text += about.dump();
  }
  return text;
}

// A studio in a temporary folder with two scans, and the requests of its page.
class Studio {
 public:
  Studio() {
    fs::create_directory(state_);
    store_ = std::make_unique<DiskStore>(*take_state_folder(state_));
    actions_ = std::make_unique<Actions>(documents_, *store_);
    for (const char* sample : {"shell", "still_life"}) {
      const std::vector<std::byte> ply = write_ply(*make_sample(sample, {.points = 2000}));
      std::ofstream(path(sample), std::ios::binary)
          .write(reinterpret_cast<const char*>(ply.data()), std::ssize(ply));
    }
  }
  ~Studio() { fs::remove_all(folder_); }

  Told ask(const std::string& action, const Json& json) {
    Answer answer;
    try {
      answer = actions_->run(action, json);
    } catch (const std::bad_alloc&) {  // as the server does
      return out_of_memory;
    }
    if (answer.status == out_of_memory.status) return out_of_memory;
    return {answer.status, without_times(answer)};
  }

  // Opens a scan, and waits until its view is prepared. Different numbers `copy` stand for different scans.
  Told open(const std::string& sample, int copy) {
    const std::string scan = path(sample + std::to_string(copy));
    if (!fs::exists(scan)) fs::create_hard_link(path(sample), scan);
    const Json request{{"input", {{"path", scan}}}, {"tab", "t"}, {"view", "front"}};
    const Told opened = ask("open", request);
    if (opened == out_of_memory) return opened;
    document_ = Json::parse(opened.text)["document"];
    return prepared();
  }

  Told turn_to(const std::string& view) {
    const Told asked = ask("view", {{"document", document_}, {"view", view}});
    return asked.status == 200 ? prepared() : asked;
  }

  Json of_document(Json json) const {
    json["document"] = document_;
    return json;
  }

  // Returns whether the studio is still busy after a minute.
  bool is_stuck() {
    const auto engine = documents_.find(document_);
    for (int look = 0; look < 60000; ++look) {
      const EngineStatus status = engine->status();
      if (!status.is_busy && status.making_stage.empty()) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
  }

 private:
  std::string path(const std::string& sample) const { return folder_ + "/" + sample + ".ply"; }

  Told prepared() {
    const auto engine = documents_.find(document_);
    while (!engine->is_idle()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const std::optional<Error> error = engine->status().error;
    if (!error) return {200, document_};
    return error->kind == ErrorKind::memory ? out_of_memory : Told{409, error->message()};
  }

  std::string folder_ = [] {
    std::string name = fs::temp_directory_path() / "relievo-memory-XXXXXX";
    return std::string(::mkdtemp(name.data()));
  }();
  std::string state_ = folder_ + "/state";
  OpenDocuments documents_;
  std::unique_ptr<DiskStore> store_;
  std::unique_ptr<Actions> actions_;
  std::string document_;
};

// Returns which of the `all` allocations of a request are to fail, one in each repetition. Their numbers are
// evenly spaced. There are about `usual` of them, or as many as the environment variable ALLOCATIONS says.
std::vector<long> chosen(long all, long usual) {
  const char* const asked = std::getenv("ALLOCATIONS");
  const long most = asked ? std::atol(asked) : usual;
  std::vector<long> numbers;
  const long step = most > 0 ? std::max(1L, all / most) : 1;
  for (long n = 1; n <= all; n += step) numbers.push_back(n);
  return numbers;
}

class StudioMemory : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    set_thread_count(GetParam());
    ASSERT_EQ(studio_.open("shell", 0).status, 200);
  }
  void TearDown() override { set_thread_count(0); }

  // Makes a request without faults. Then repeats it several times, each time with another failing allocation.
  template <typename Request>
  void survives(const Request& request, long usual = 12) {
    const Told whole = request();
    ASSERT_EQ(whole.status, 200) << whole.text;
    ASSERT_EQ(request(), whole);
    const long all = [&] {
      const FailingAllocation none({.first = 1L << 60, .least_bytes = few_bytes});
      (void)request();
      return none.counted();
    }();
    ASSERT_GT(all, 0);
    for (const long count : {1, 1000000})  // fail: allocation n, or all allocations from n on
      for (const long n : chosen(all, usual)) try_once(request, whole, {n, count, few_bytes});
  }

  // Returns the answer to a request while allocations fail. Returns out_of_memory if an allocation of the
  // test itself fails.
  template <typename Request>
  static Told with_fault(const test::AllocationFault& fault, const Request& request) {
    const FailingAllocation failing(fault);
    try {
      return request();
    } catch (const std::bad_alloc&) {
      return out_of_memory;
    }
  }

  template <typename Request>
  void try_once(const Request& request, const Told& whole, const test::AllocationFault& fault) {
    const Told told = with_fault(fault, request);
    const std::string which =
        "allocation " + std::to_string(fault.first) + " and so many more: " + std::to_string(fault.count - 1);
    refused_ += told == out_of_memory;
    EXPECT_TRUE(told == whole || told == out_of_memory)
        << which << ": " << told.status << " " << told.text.substr(0, 300);
    EXPECT_FALSE(studio_.is_stuck()) << which;
    EXPECT_EQ(request(), whole) << which;
  }

  Told ask(const std::string& action, Json json) {
    return studio_.ask(action, studio_.of_document(std::move(json)));
  }

  Studio studio_;
  int refused_ = 0;
};

Json picture_request(Json options) {
  options["resolution"] = 2;
  return {{"width", 48}, {"height", 32}, {"options", std::move(options)}};
}

TEST_P(StudioMemory, OpensAnotherScan) {
  int copy = 1;
  survives([&] {
    const Told told = studio_.open("still_life", copy);
    if (told.status != 200) return told;
    ++copy;
    return Told{200, ""};
  });
  EXPECT_GT(refused_, 0);
}

TEST_P(StudioMemory, KeepsTheScanThatItHad) {
  const Json request = studio_.of_document(picture_request({}));
  const Told picture = studio_.ask("picture", request);
  ASSERT_EQ(picture.status, 200);
  for (const long n : {5, 50, 100, 200}) {
    const test::AllocationFault fault{n, 1000000, few_bytes};
    EXPECT_EQ(with_fault(fault, [&] { return studio_.open("still_life", 1); }), out_of_memory);
    EXPECT_EQ(studio_.ask("picture", request), picture);
  }
}

TEST_P(StudioMemory, ShowsAnotherView) {
  survives([&] {
    const Told there = studio_.turn_to("left"), back = studio_.turn_to("front");
    return there == out_of_memory ? there : back;
  });
  EXPECT_GT(refused_, 0);
}

TEST_P(StudioMemory, Turns) {
  Json request = picture_request({{"height", 2}});
  request["turned"] = {{"towards", {.3, 0, 1}}, {"up", {0, 1, 0}}};
  double angle = .3;
  survives([&] {
    Json asked = request;
    asked["turned"]["towards"][0] = angle = angle > .35 ? .3 : angle + .01;
    const Told told = ask("picture", asked);
    return told.status == 200 ? Told{200, ""} : told;
  });
  EXPECT_GT(refused_, 0);
}

TEST_P(StudioMemory, DrawsFrames) {
  for (const char* kind : {"plain", "round", "original"}) {
    Json request = picture_request({{"height", 3}, {"outline", kind[0] == 'r' ? "ellipse" : "rectangle"}});
    request["original"] = kind[0] == 'o';
    survives([&] { return ask("picture", request); });
  }
  survives([&] {
    return ask("scan", {{"towards", {0, 0, 1}}, {"up", {0, 1, 0}}, {"width", 48}, {"height", 32}});
  });
  EXPECT_GT(refused_, 0);
}

TEST_P(StudioMemory, DrawsAnotherFrameEachTime) {
  double height = 2;
  survives([&] {
    height = height > 2 ? 2 : 2.5;
    const Told told = ask("picture", picture_request({{"height", height}}));
    return told.status == 200 ? Told{200, ""} : told;
  });
}

TEST_P(StudioMemory, MakesPiecesAndFiles) {
  for (const char* format : {"stl", "3mf", "heightmap", "preview"}) {
    double rim = 2;
    survives(
        [&] {
          rim = rim > 2 ? 2 : 2.5;  // another rim forces a new piece
          Json request = picture_request({{"height", 2}, {"rim", rim}});
          request["format"] = format;
          request["pixels"] = 16;
          const Told told = ask("export", request);
          return told.status == 200 ? Told{200, ""} : told;
        },
        8);
  }
  EXPECT_GT(refused_, 0);
}

TEST_P(StudioMemory, ExportsTheSameBytesAfterwards) {
  Json request = picture_request({{"height", 2}, {"draft", 20}});
  request["format"] = "stl";
  survives([&] { return ask("export", request); });
}

TEST_P(StudioMemory, KeepsWork) {
  double changed = 1;
  survives([&] {
    const Json state{{"changed", ++changed}, {"text", std::string(1000, 'x')}};
    return ask("state", {{"state", state}, {"tab", "t"}});
  });
  EXPECT_EQ(ask("status", Json::object()).status, 200);
}

INSTANTIATE_TEST_SUITE_P(Threads, StudioMemory, testing::Values(1, 2), testing::PrintToStringParamName());

}  // namespace
}  // namespace relievo::app::studio
