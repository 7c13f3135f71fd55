#include "report/drawing.hpp"

#include "report/colours.hpp"

namespace bitshade {

std::string svg_file(const plot& p) {
  std::string style =
      "svg { background: #fff; font: 12.5px sans-serif; } text { fill: #1d2126; }"
      ".title { fill: #5b6470; } .grid { stroke: #e4e7e9; } .axis { stroke: #5b6470; }"
      ".compare-with { stroke: #5b6470; stroke-dasharray: 2 3; }"
      ".line { fill: none; stroke-width: 2; } .mark { stroke: #fff; }"
      ".line.cm { stroke: #5b6470; stroke-dasharray: 6 4; } .mark.cm { fill: #5b6470; }";
  const auto colours = categories();
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const std::string name = ".c" + std::to_string(i), colour = hex(colours[i]);
    style += ".line" + name + " { stroke: " + colour + "; } .mark" + name + " { fill: " + colour +
             "; } .mark.hollow" + name + " { fill: #fff; stroke: " + colour + "; }";
  }
  std::string drawing = svg(p);
  const std::string head = "<svg ";
  drawing.replace(0, head.size(), "<svg xmlns=\"http://www.w3.org/2000/svg\" ");
  drawing.insert(drawing.find('>') + 1, "<style>" + style + "</style>");
  return drawing + "\n";
}

}  // namespace bitshade
