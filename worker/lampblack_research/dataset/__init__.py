"""From meshes to drawings with exact truth."""
