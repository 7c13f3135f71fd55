// report.html in a real browser: no errors, tables sort, the slider moves.
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "support/catch.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

using namespace bitshade::test;
using nlohmann::json;

namespace {

// Runs after the page's own script and leaves what it found in the page.
constexpr const char* probe = R"js(<script>
window.addEventListener('load', () => {
  const found = {errors: window.bitshadeErrors};
  found.loads = [...document.images].every(i => i.complete && i.naturalWidth > 0);
  const tables = [...document.querySelectorAll('table.sorts')];
  // Every heading of every table sorts its column, first upwards.
  found.tables = tables.length;
  found.unsorted = [];
  for (const t of tables) [...t.tHead.rows[0].cells].forEach((head, column) => {
    head.querySelector('button').click();
    const value = r => r.cells[column].dataset.value ?? r.cells[column].textContent;
    const rows = [...t.tBodies[0].rows].map(value);
    const number = rows.every(v => v !== '' && !Number.isNaN(Number(v)));
    for (let i = 1; i < rows.length; ++i)
      if (number ? Number(rows[i - 1]) > Number(rows[i]) : rows[i - 1].localeCompare(rows[i]) > 0)
        found.unsorted.push(head.textContent + ': ' + rows[i - 1] + ', ' + rows[i]);
    if (head.getAttribute('aria-sort') !== 'ascending') found.unsorted.push(head.textContent);
  });
  const table = tables.find(t => t.tHead.textContent.includes('total RMSE'));
  const column = 3, button = table.tHead.rows[0].cells[column].querySelector('button');
  const values = () => [...table.tBodies[0].rows].map(r => Number(r.cells[column].dataset.value));
  button.click(); found.up = values();
  button.click(); found.down = values();
  found.sort = table.tHead.rows[0].cells[column].getAttribute('aria-sort');
  const figure = document.querySelector('figure.slider'), compare = figure.querySelector('.compare');
  const range = compare.querySelector('input');
  range.value = 80; range.dispatchEvent(new Event('input'));
  const over = compare.querySelector('.over');
  found.clip = getComputedStyle(over).clipPath;
  found.width = compare.getBoundingClientRect().width;
  const before = compare.querySelector('img.b').src;
  const choice = figure.querySelector('select[name=b]');
  choice.selectedIndex = choice.options.length - 1; choice.dispatchEvent(new Event('change'));
  found.changed = compare.querySelector('img.b').src !== before;
  const kind = figure.querySelector('select[name=kind]');
  kind.value = 'error'; kind.dispatchEvent(new Event('change'));
  found.error = compare.querySelector('img.b').alt;
  found.headings = [...document.querySelectorAll('h3')].map(h => h.textContent);
  found.first = document.querySelector('ul.findings li').textContent;
  // Labels of one axis stand clear of each other.
  found.crowded = [];
  for (const svg of document.querySelectorAll('svg')) {
    const labels = [...svg.querySelectorAll('text')].map(t => [t.textContent, t.getBoundingClientRect()]);
    labels.forEach(([a, r], i) => labels.slice(i + 1).forEach(([b, s]) => {
      if (r.left < s.right - 1 && s.left < r.right - 1 && r.top < s.bottom - 3 && s.top < r.bottom - 3)
        found.crowded.push(a + ' | ' + b);
    }));
  }
  found.plots = document.querySelectorAll('svg').length;
  found.commands = [...document.querySelectorAll('figure')].every(
      f => f.querySelector('code.command') && f.querySelector('code.command').textContent.startsWith('bitshade '));
  found.scroll = document.documentElement.scrollWidth - window.innerWidth;
  found.remote = performance.getEntriesByType('resource').filter(r => !r.name.startsWith('data:')).length;
  const pre = document.createElement('pre');
  pre.id = 'probe'; pre.textContent = 'PROBE' + JSON.stringify(found) + 'EBORP';
  document.body.append(pre);
});
</script>)js";

std::string browser() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
    if (run_program({"sh", "-c", std::string("command -v ") + name}).status == 0) return name;
  return "";
}

json probe_page(const temporary_folder& folder, std::string page, const std::string& window) {
  page.insert(
      page.find("<head>") + 6,
      "<script>window.bitshadeErrors = [];"
      "window.addEventListener('error', e => window.bitshadeErrors.push(String(e.message)), true);"
      "const bitshadeSay = console.error;"
      "console.error = (...a) => { window.bitshadeErrors.push(a.join(' ')); bitshadeSay(...a); };"
      "</script>");
  page.insert(page.rfind("</body>"), probe);
  write(folder / "probe.html", page);
  const outcome o = run_program(
      {"timeout", "120", browser(), "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic",
       "--no-first-run", "--disable-background-networking", "--disable-component-update",
       "--disable-sync", "--user-data-dir=" + (folder / "profile").string(),
       "--window-size=" + window, "--enable-logging=stderr", "--virtual-time-budget=8000",
       "--dump-dom", "file://" + (folder / "probe.html").string()});
  const std::size_t begin = o.out.rfind("PROBE{"), end = o.out.rfind("}EBORP");
  INFO("browser: " << o.err.substr(0, 2000));
  REQUIRE(begin != std::string::npos);
  REQUIRE(end != std::string::npos);
  CHECK(o.err.find(":CONSOLE(") == std::string::npos);
  std::string text = o.out.substr(begin + 5, end + 1 - begin - 5);
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"&gt;", ">"}, {"&lt;", "<"}, {"&amp;", "&"}})
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos;)
      text.replace(at, from.size(), to);
  return json::parse(text);
}

/// What holds for every report: nothing fails, nothing is fetched, everything works and fits.
void check_page(const json& found) {
  CAPTURE(found.dump());
  CHECK(found.at("errors").empty());
  CHECK(found.at("unsorted").empty());
  CHECK(found.at("crowded").empty());
  CHECK(found.at("clip").get<std::string>().find("20%") != std::string::npos);
  CHECK(found.at("changed") == true);
  CHECK(found.at("loads") == true);
  CHECK(found.at("error").get<std::string>().starts_with("error against the truth of"));
  CHECK(found.at("plots").get<int>() >= 4);
  CHECK(found.at("commands") == true);
  CHECK(found.at("remote") == 0);
  CHECK(found.at("scroll").get<double>() <= 0);  // nothing wider than the window
}

}  // namespace

TEST_CASE("report.html works in a browser, wide and narrow", "[app]") {
  if (browser().empty()) {
    WARN("skipped: no chromium on this machine; 'apt-get install chromium' brings it");
    return;
  }
  const temporary_folder folder;
  const outcome o = run_bitshade({"study", "garden", "--size", "96", "--view", "80x50", "--layers",
                                  "1,2", "--blame", "--precision", "--seed", "5", "--out",
                                  (folder / "out").string()});
  INFO(o.err);
  REQUIRE(o.status == 0);
  const std::string page = contents(folder / "out/report.html");
  CHECK(page.find("http://") == std::string::npos);
  CHECK(page.find("https://") == std::string::npos);
  CHECK(page.find("Seed 5") != std::string::npos);
  for (const char* window : {"1280,900", "390,844"}) {
    CAPTURE(window);
    const json found = probe_page(folder, page, window);
    check_page(found);
    const auto up = found.at("up").get<std::vector<double>>();
    const auto down = found.at("down").get<std::vector<double>>();
    CHECK(up.size() == 12);
    CHECK(up.front() < up.back());
    CHECK(std::is_sorted(up.begin(), up.end()));
    CHECK(std::is_sorted(down.rbegin(), down.rend()));
    CHECK(found.at("sort") == "descending");
    // The summary in words comes first, and opens with what stands in for a VSM in binary32.
    CHECK(found.at("first").get<std::string>().find("a binary32 VSM on this scene") !=
          std::string::npos);
    std::string headings;
    for (const json& h : found.at("headings")) headings += h.get<std::string>() + "\n";
    for (const char* part : {"Which stage is guilty", "Bits against layers", "Pictures"}) {
      CAPTURE(part, headings);
      CHECK(headings.find(part) != std::string::npos);
    }
  }
}

TEST_CASE("pareto's report works in a browser", "[app]") {
  if (browser().empty()) {
    WARN("skipped: no chromium on this machine; 'apt-get install chromium' brings it");
    return;
  }
  const temporary_folder folder;
  const outcome o = run_bitshade({"pareto", "garden", "--size", "64", "--view", "48x30",
                                  "--repeats", "1", "--techniques", "pcf,vsm,lvsm", "--layers", "2",
                                  "--out", (folder / "out").string()});
  INFO(o.err);
  REQUIRE(o.status == 0);
  const json found = probe_page(folder, contents(folder / "out/report.html"), "390,844");
  check_page(found);
  CHECK(found.at("tables") == 3);
  CHECK(found.at("plots").get<int>() >= 6);
}
