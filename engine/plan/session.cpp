// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/session.h"

#include "engine/io/file_identity.h"

#include <algorithm>
#include <numeric>

namespace keyline {

std::shared_ptr<const ColorConfig> Session::colors(const std::filesystem::path& file) {
    const std::lock_guard lock(mutex_);
    const Digest identity = file.empty() ? Digester("built-in").digest() : file_identity(file);
    // By its name too, which messages tell.
    const bool is_it =
        colors_.config && identity.known() && colors_.identity == identity && colors_.file == file;
    if (!is_it) {
        colors_ = {file, identity, file.empty() ? ColorConfig::builtin() : ColorConfig::load(file)};
        ++counts_.configs_loaded;
    }
    return colors_.config;
}

std::shared_ptr<const ImageSource> Session::open(const std::filesystem::path& file,
                                                 const OpenOptions& options) {
    const Digest digest = image_digest(file, options);
    const std::lock_guard lock(mutex_);
    const auto it = std::ranges::find_if(images_, [&](const auto& image) {
        return digest.known() && image->digest() == digest && image->header().file == file;
    });
    if (it != images_.end()) {
        images_.splice(images_.begin(), images_, it);
        return images_.front();
    }
    std::shared_ptr<const ImageSource> image = open_image(file, options);
    ++counts_.images_opened;
    if (!image->rest()) return image;
    images_.push_front(image);
    if (images_.size() > kImages) images_.pop_back();
    return image;
}

std::shared_ptr<const ImageSource> Session::shared(std::shared_ptr<const ImageSource> source) {
    const Digest digest = source->digest();
    if (!digest.known()) return source;
    const std::lock_guard lock(mutex_);
    std::erase_if(in_use_, [](const auto& entry) { return entry.second.expired(); });
    std::weak_ptr<const ImageSource>& known = in_use_[digest];
    if (auto other = known.lock(); other && other->header().file == source->header().file) return other;
    known = source;
    return source;
}

Session::Made Session::remember(const Digest& key, std::type_index type, std::size_t bytes,
                                const std::function<Made()>& make) {
    const std::lock_guard lock(mutex_);
    const std::pair full_key(key, type);
    const auto it = std::ranges::find(values_, full_key, &Value::key);
    if (it != values_.end()) {
        values_.splice(values_.begin(), values_, it);
        return it->made;
    }
    Made made = make();
    ++counts_.values_made;
    if (!key.known()) return made;
    values_.push_front({full_key, bytes, made});
    std::size_t sum = 0;
    const auto too_much =
        std::ranges::find_if(values_, [&](const Value& v) { return (sum += v.bytes) > kBytes; });
    values_.erase(too_much, values_.end());
    return made;
}

Session::Counts Session::counts() const {
    const std::lock_guard lock(mutex_);
    return counts_;
}

std::size_t Session::images_kept() const {
    const std::lock_guard lock(mutex_);
    return images_.size();
}

std::size_t Session::bytes_kept() const {
    const std::lock_guard lock(mutex_);
    return std::accumulate(values_.begin(), values_.end(), std::size_t{0},
                           [](std::size_t sum, const Value& v) { return sum + v.bytes; });
}

}  // namespace keyline
