float share_of_private_library() { return 0.5f; }
