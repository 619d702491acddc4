// Arrays that end, or begin, at memory without access, so that whoever reads outside them is found.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

/// Where the memory without access lies.
enum class Fence : bool { before, after };

/// Zero-filled memory of some bytes, next to pages that can neither be read nor written. In messages it is
/// called `name`.
class Fenced {
  public:
    Fenced(std::string name, std::size_t bytes, Fence fence);
    Fenced(const Fenced&) = delete;
    Fenced& operator=(const Fenced&) = delete;
    ~Fenced();

    /// The memory as an array.
    template <class T>
    T* as() const {
        return static_cast<T*>(memory_);
    }

    const std::string& name() const { return name_; }
    Fence fence() const { return fence_; }
    /// Whether the address is within the memory without access.
    bool is_beyond(const void* address) const;

  private:
    std::string name_;
    Fence fence_;
    std::byte* all_ = nullptr;
    std::size_t size_ = 0;  // of all
    void* memory_ = nullptr;
};

/// Calls `call`, which reads or writes outside no Fenced: "reads past the end of normal.x" if it does, and
/// empty otherwise. What the call has allocated is lost then. Faults elsewhere, and on other threads, end the
/// process as always.
std::string trespass_of(const std::function<void()>& call);
