// Names of temporary files, where signal handlers find them.
module;

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>

module candela.util:unfinished;

namespace candela {

/// A new name in a directory for a temporary file. The file is removed with this object, and by
/// remove_unfinished_files().
class UnfinishedName {
  public:
    explicit UnfinishedName(const std::filesystem::path& directory);
    UnfinishedName(const UnfinishedName&) = delete;
    UnfinishedName& operator=(const UnfinishedName&) = delete;
    ~UnfinishedName();

    const char* c_str() const { return name_->c_str(); }

  private:
    std::unique_ptr<std::string> name_;
    std::atomic<std::string*>* slot_ = nullptr;
};

}  // namespace candela
