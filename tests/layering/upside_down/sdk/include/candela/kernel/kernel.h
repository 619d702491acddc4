// If installed, it would replace api's kernel.h, or be replaced by it.
