// Arrays that end, or begin, at inaccessible memory, so that accesses outside them are detected.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

/// On which side the inaccessible memory is.
enum class Fence : bool { before, after };

/// Zero-filled memory of a given size, next to pages that can be neither read nor written. Messages call it
/// `name`.
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
    /// Whether the address is within the inaccessible memory.
    bool is_beyond(const void* address) const;

  private:
    std::string name_;
    Fence fence_;
    std::byte* all_ = nullptr;
    std::size_t size_ = 0;  // in total
    void* memory_ = nullptr;
};

/// Calls `call`. Returns "reads past the end of normal.x" if it reads or writes outside a Fenced, otherwise
/// an empty string. In the former case, what the call has allocated leaks. Other faults, and those on other
/// threads, end the process as usual.
std::string trespass_of(const std::function<void()>& call);
