#include "loaded.h"

#include <array>
#include <filesystem>
#include <map>
#include <system_error>
#include <tuple>
#include <utility>

#include "orientation.h"

namespace mesh {

Loaded::Loaded(mesh_io::Surface whole, bool keeps_sides) : surface_(std::move(whole)) {
    if (keeps_sides) return;
    joined();
    if (turn_outwards(surface_, joined_->corners, joined_->open)) joined_->corners = Corners(surface_);
}

const Loaded::Joined& Loaded::joined() const {
    std::call_once(is_joined_, [&] {
        Corners corners(surface_);
        OpenEdges open = open_edges(surface_, corners);
        joined_.emplace(Joined{std::move(corners), std::move(open)});
    });
    return *joined_;
}

const TrianglesByMaterial& Loaded::by_material() const {
    std::call_once(is_sorted_, [&] { by_material_.emplace(surface_); });
    return *by_material_;
}

std::shared_ptr<const SplitVertices> Loaded::split(double crease_angle) const {
    {
        const std::scoped_lock lock(splitting_);
        if (split_ != nullptr && split_angle_ == crease_angle) return split_;
    }
    // Unlocked: a thread that waits for others may be given work that enters this function.
    auto made = std::make_shared<const SplitVertices>(split_at_creases(surface_, corners(), crease_angle));
    const std::scoped_lock lock(splitting_);
    split_ = made;
    split_angle_ = crease_angle;
    return made;
}

std::shared_ptr<SharedFile> SharedFile::of(const std::string& file, const mesh_io::Origin& origin,
                                           mesh_io::FileScope reach, bool keeps_sides) {
    static std::mutex mutex;
    static std::map<std::tuple<std::string, std::array<double, 3>, mesh_io::FileScope, bool>,
                    std::weak_ptr<SharedFile>>
        files;
    std::error_code problem;
    const std::filesystem::path path =
        std::filesystem::weakly_canonical(std::filesystem::absolute(file, problem), problem);
    const std::scoped_lock lock(mutex);
    std::weak_ptr<SharedFile>& known = files[{problem ? file : path.string(), origin.at, reach, keeps_sides}];
    std::shared_ptr<SharedFile> shared = known.lock();
    if (shared == nullptr) {
        shared.reset(new SharedFile(file));
        known = shared;
        std::erase_if(files, [](const auto& each) { return each.second.expired(); });
    }
    return shared;
}

std::shared_ptr<const Loaded> SharedFile::loaded(mesh_io::Attributes attributes,
                                                 const std::function<std::shared_ptr<const Loaded>()>& read) {
    const auto states_now = [&](const mesh_io::Surface* surface) {
        std::vector<mesh_io::FileState> states{mesh_io::state_of(file_)};
        if (surface != nullptr)
            for (const std::filesystem::path& part : surface->files)
                states.push_back(mesh_io::state_of(part));
        return states;
    };
    {
        const std::scoped_lock lock(mutex_);
        if (loaded_ != nullptr && attributes_ >= attributes && states_ == states_now(&loaded_->surface()))
            return loaded_;
    }
    // Unlocked: a thread that waits for others within read() may be given work that enters this function.
    const mesh_io::FileState before = mesh_io::state_of(file_);
    std::shared_ptr<const Loaded> result = read();
    std::vector<mesh_io::FileState> states = states_now(&result->surface());
    states[0] = before;
    const std::scoped_lock lock(mutex_);
    loaded_ = result;
    attributes_ = attributes;
    states_ = std::move(states);
    return result;
}

}  // namespace mesh
