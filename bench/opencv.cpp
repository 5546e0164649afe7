// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0

// Edges of a picture in memory, Keyline's of floats against OpenCV's of bytes, in turn in one process:
//     bench_opencv PLATE.exr RUNS.csv ROUNDS
// Says how many pixels each found: the work is about the same.

#include "bench/memory_graph.h"
#include "bench/plate.h"
#include "bench/run_log.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fmt/format.h>
#include <iostream>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <thread>

namespace keyline::bench {
namespace {

constexpr double kSigma = 1.4, kLow = 0.04, kHigh = 0.12;
// OpenCV's steps are of 1/255, and its Sobel's weights are four times those of [-1 0 1].
constexpr double kOpenCvScale = 255 * 4;

std::string edge_nodes() {
    return fmt::format(R"(
        "smooth": {{"type": "gaussian", "in": "a", "sigma": {}}},
        "slope": {{"type": "gradient", "in": "smooth"}},
        "thin": {{"type": "nms", "in": "slope"}},
        "result": {{"type": "hysteresis", "in": "thin", "low": {}, "high": {}}})",
                       kSigma, kLow, kHigh);
}

class OpenCv {
public:
    explicit OpenCv(const Picture& grey) {
        const cv::Mat floats(grey.height, grey.width, CV_32F, const_cast<float*>(grey.planes[0].data()));
        floats.convertTo(bytes_, CV_8U, 255);
    }
    void run(int threads) {
        cv::setNumThreads(threads);
        cv::GaussianBlur(bytes_, smooth_, {}, kSigma);
        cv::Canny(smooth_, edges_, kLow * kOpenCvScale, kHigh * kOpenCvScale, 3, true);
    }
    int found() const { return cv::countNonZero(edges_); }

private:
    cv::Mat bytes_, smooth_, edges_;
};

template <class F>
Measured time(F&& f) {
    const auto start = std::chrono::steady_clock::now();
    f();
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 0};
}

void run(const std::string& plate, RunLog& log, int rounds) {
    const Picture grey = grey_of(read_beauty(plate));
    OpenCv opencv(grey);
    for (const int threads : std::set{1, static_cast<int>(std::thread::hardware_concurrency())}) {
        MemoryGraph graph(edge_nodes(), grey, threads);
        graph.run();
        opencv.run(threads);
        for (int round = 0; round < rounds; ++round) {
            log.add("edges", "Keyline", threads, round, time([&] { graph.run(); }));
            log.add("edges", "OpenCV", threads, round, time([&] { opencv.run(threads); }));
        }
        std::cout << fmt::format(
            "{} threads: Keyline found {} edge pixels, OpenCV {}\n", threads,
            std::ranges::count_if(graph.result().planes[0], [](float v) { return v > 0; }), opencv.found());
    }
}

}  // namespace
}  // namespace keyline::bench

int main(int argc, char** argv) {
    if (argc != 4) {
        std::cerr << "usage: bench_opencv PLATE.exr RUNS.csv ROUNDS\n";
        return 2;
    }
    try {
        keyline::bench::RunLog log(argv[2]);
        keyline::bench::run(argv[1], log, std::atoi(argv[3]));
    } catch (const std::exception& e) {
        std::cerr << "error: " << e.what() << '\n';
        return 1;
    }
    return 0;
}
