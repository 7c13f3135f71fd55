#include "run/database.hpp"

#include "io/error.hpp"
#include "run/listing.hpp"
#include "support/catch.hpp"
#include "support/temporary_folder.hpp"

using namespace bitshade;

namespace {

row sample(const std::string& key) {
  row r;
  r.key = key;
  r.scene = "a \"quoted\", name";
  r.technique = "lvsm";
  r.format = "half";
  r.layers = 3;
  r.figures.format = {12345, 0.1, 1.0 / 3, 5e-324, -0.25};
  r.figures.bleed_area = 0x1.fffffffffffffp-2;
  r.bytes_per_texel = 12;
  r.map_seconds = 1e-3;
  r.splits = {0, 0.1, 2.0 / 3, 1};
  r.effects = {{"overlap", true, false, "0 of 7"}};
  r.notes = {"a floor below the noise"};
  return r;
}

}  // namespace

TEST_CASE("rows and pictures come back bit for bit, in their order", "[run]") {
  const temporary_folder folder;
  const row first = sample("one"), second = sample("two");
  {
    database db(folder / "results.sqlite");
    CHECK(!db.find("one"));
    db.store_cell(first, {{"visibility", std::string("\x89PNG\0x", 6)}});
    db.store_cell(second, {});
    db.store_input({"digest", "garden", "{}"}, {{"truth", "bytes"}});
  }
  const database db(folder / "results.sqlite");
  const auto found = db.find("one");
  REQUIRE(found);
  CHECK(to_json(*found) == to_json(first));
  CHECK(db.pictures("one").at("visibility") == std::string("\x89PNG\0x", 6));
  CHECK(db.pictures("digest").at("truth") == "bytes");
  CHECK(db.inputs().size() == 1);
  REQUIRE(db.rows().size() == 2);
  CHECK(db.rows()[1].key == "two");
}

TEST_CASE("merging takes over what is missing, once", "[run]") {
  const temporary_folder folder;
  {
    database a(folder / "a.sqlite"), b(folder / "b.sqlite");
    a.store_cell(sample("one"), {});
    b.store_cell(sample("one"), {});
    b.store_cell(sample("two"), {{"error", "png"}});
  }
  database a(folder / "a.sqlite");
  CHECK(a.merge(folder / "b.sqlite") == 1);
  CHECK(a.merge(folder / "b.sqlite") == 0);
  CHECK(a.rows().size() == 2);
  CHECK(a.pictures("two").at("error") == "png");
}

TEST_CASE("a cell that fails to enter leaves nothing behind", "[run]") {
  const temporary_folder folder;
  database db(folder / "results.sqlite");
  database other(folder / "results.sqlite");
  db.store_cell(sample("one"), {});
  CHECK(other.find("one"));
  CHECK_THROWS_AS(database(folder / "missing.sqlite", database::access::read), failure);
  CHECK_THROWS_AS(database(folder / "no/such/folder.sqlite"), failure);
}

TEST_CASE("CSV quotes what would break a line apart", "[run]") {
  const std::vector<row> rows{sample("one")};
  const std::string csv = to_csv(rows);
  CHECK(csv.find("\"a \"\"quoted\"\", name\"") != std::string::npos);
  CHECK(csv.find("0 0.1 0.6666666666666666 1\n") != std::string::npos);
}
