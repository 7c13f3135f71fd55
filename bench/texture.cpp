// Images against what memory and a hand-written loop allow: sampling, blur, mip chains, tables.
#include "texture/images.hpp"

int main(int argc, char** argv) {
  bench::table table;
  bench::add_sampling(table);
  for (const int channels : {1, 2}) {
    bench::add_blurs(table, channels);
    bench::add_mips(table, channels);
    bench::add_tables(table, channels);
  }
  bench::add_blur_ways(table);
  return table.run(argc, argv);
}
