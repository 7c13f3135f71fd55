// Threads that wait between calls: every piece once, whoever does it, asleep or not.
#include "bitshade/arithmetic/workers.hpp"

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include "bitshade/arithmetic/bulk.hpp"
#include "support/catch.hpp"

using namespace bitshade;

TEST_CASE("workers do each piece once and return when all are done") {
  for (const unsigned threads : {0u, 1u, 2u, 5u}) {
    bulk::workers crew(threads);
    CHECK(crew.threads() == std::max(1u, threads));
    for (const unsigned pieces : {0u, 1u, 2u, 3u, 64u, 1000u}) {
      for (int again = 0; again < 50; ++again) {
        std::vector<int> times(pieces);
        crew.run(pieces, [&](unsigned k) { ++times[k]; });
        REQUIRE(times == std::vector<int>(pieces, 1));
      }
    }
  }
}

TEST_CASE("workers that fell asleep are woken, and end asleep") {
  bulk::workers crew(3);
  for (int again = 0; again < 5; ++again) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    std::atomic<unsigned> sum = 0;
    crew.run(10, [&](unsigned k) { sum += k; });
    CHECK(sum == 45);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

TEST_CASE("pieces of a call run at once, begun in order") {
  // Piece 1 ends piece 0: one thread after the other would never return.
  bulk::workers crew(2);
  for (int again = 0; again < 20; ++again) {
    std::atomic<bool> begun = false;
    crew.run(2, [&](unsigned k) {
      if (k == 1) begun = true;
      while (k == 0 && !begun) std::this_thread::yield();
    });
  }
  bulk::workers alone(1);
  std::vector<unsigned> order;
  alone.run(4, [&](unsigned k) { order.push_back(k); });
  CHECK(order == std::vector<unsigned>{0, 1, 2, 3});
}

TEST_CASE("an exception in a piece reaches the caller, once, after the others") {
  bulk::workers crew(3);
  std::atomic<int> done = 0;
  const auto work = [&](unsigned k) {
    if (k % 7 == 3) throw std::runtime_error("piece");
    ++done;
  };
  CHECK_THROWS_AS(crew.run(21, work), std::runtime_error);
  CHECK(done == 18);
  crew.run(3, [&](unsigned) { ++done; });
  CHECK(done == 21);
}

TEST_CASE("bulk gives the same bits on threads that wait") {
  bulk::workers crew(3);
  std::vector<float> in(100001), one(in.size()), many(in.size());
  for (std::size_t i = 0; i < in.size(); ++i) in[i] = static_cast<float>(i) * 0x1.9p-17f;
  rules random;
  random.direction = rounding::stochastic;
  bulk::round(binary16::value, random, in, one, {.seed = 7});
  bulk::round(binary16::value, random, in, many, {.seed = 7, .crew = &crew});
  CHECK(one == many);
}
