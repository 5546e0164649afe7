// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/exr/file.h"
#include "engine/io/exr/header.h"

#include <cstdint>
#include <span>

// Whether a file has all its chunks, as its tables of offsets tell: a file that is being written, or was cut
// off, opens like any other.

namespace keyline::exr {

// Throws Failure (kInput) for a file whose chunks are not all there; with a region, those of flat parts that
// hold some of its rows: what is there can be read.  Reads the tables and the head of one chunk.  `tables`:
// where they begin, behind the headers.
void check_chunk_tables(const InputFile& file, const ReadContext& context, std::span<const Part> parts,
                        uint64_t tables, const Rect* region = nullptr);

// Whether a file of one flat part is such as Keyline writes: chunk behind chunk, each with the rows that it
// must have, to the file's end.  Reads the head of every chunk.
bool has_chunks_in_line(const InputFile& file, const ReadContext& context, const Part& part, uint64_t tables);

}  // namespace keyline::exr
