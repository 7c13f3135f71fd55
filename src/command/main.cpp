#include "command/commands.hpp"

int main(int argc, char* argv[]) { return bitshade::command::run(argc, argv); }
