// Which program this is, and on which machine it runs: the head of every report.
#pragma once

#include <string>

namespace bitshade {

/// "0.1.0+1a2b3c4d5e6f": the version and the start of the linker's build identity, which changes
/// with any byte of the program. Stored results of another build are never taken for this one's.
std::string program_version();

/// The compiler that built the program.
std::string compiler_description();

/// The processor's name and number of cores.
std::string machine_description();

/// `word` as a POSIX shell reads it back.
std::string shell_quoted(const std::string& word);

}  // namespace bitshade
