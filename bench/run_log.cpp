// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/run_log.h"

#include <fmt/format.h>
#include <stdexcept>

namespace keyline::bench {

RunLog::RunLog(const std::filesystem::path& file) {
    const bool is_new = !std::filesystem::exists(file);
    out_.open(file, std::ios::app);
    if (is_new) out_ << "experiment,what,x,round,seconds,mib\n" << std::flush;
    if (!out_) throw std::runtime_error("cannot write " + file.string());
}

void RunLog::add(const std::string& experiment, const std::string& what, double x, int round,
                 const Measured& run) {
    out_ << fmt::format("{},\"{}\",{},{},{:.6f},{:.1f}\n", experiment, what, x, round, run.seconds,
                        static_cast<double>(run.peak_bytes) / (1 << 20))
         << std::flush;
    if (!out_) throw std::runtime_error("cannot write the runs");
}

}  // namespace keyline::bench
