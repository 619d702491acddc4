// Installed, it would replace the kernel.h of api, or be replaced by it.
