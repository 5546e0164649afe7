// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace keyline {

// Things that are costly to make and used by one thread at a time: as many are made as are ever used at once.
template <class T>
class Pool {
public:
    explicit Pool(std::function<std::unique_ptr<T>()> make) : make_(std::move(make)) {}

    // A thing of one's own until the lease ends.
    class Lease {
    public:
        Lease(Pool& pool, std::unique_ptr<T> thing) : pool_(pool), thing_(std::move(thing)) {}
        ~Lease() {
            if (thing_) pool_.give_back(std::move(thing_));
        }
        Lease(Lease&&) noexcept = default;
        Lease(const Lease&) = delete;
        Lease& operator=(const Lease&) = delete;
        T& operator*() const { return *thing_; }
        T* operator->() const { return thing_.get(); }

    private:
        Pool& pool_;
        std::unique_ptr<T> thing_;
    };

    Lease take() {
        {
            const std::scoped_lock lock(mutex_);
            if (!idle_.empty()) {
                std::unique_ptr<T> thing = std::move(idle_.back());
                idle_.pop_back();
                return Lease(*this, std::move(thing));
            }
        }
        return Lease(*this, make_());
    }

    // Drops those that nobody uses.
    void clear() {
        std::vector<std::unique_ptr<T>> idle;
        const std::scoped_lock lock(mutex_);
        idle.swap(idle_);
    }

private:
    void give_back(std::unique_ptr<T> thing) {
        const std::scoped_lock lock(mutex_);
        idle_.push_back(std::move(thing));
    }

    std::function<std::unique_ptr<T>()> make_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<T>> idle_;
};

}  // namespace keyline
