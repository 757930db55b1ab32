// A scene in a file: the sidecar of a project, the same that `lampblack render --scene` reads.
#pragma once

#include "scene/scene.h"
#include "user_error.h"

#include <variant>

namespace lampblack
{

/// The file's scene, or why it cannot be used.
std::variant<Scene, UserError> readSceneFile(const QString& path);

/// Write the scene, whole or not at all. A file there that is no scene is first moved aside.
std::optional<UserError> writeSceneFile(const QString& path, const Scene& scene);

/// Move a file that is no scene to "<path>.broken" (".broken2", ... if that is taken); its new path, empty
/// if that cannot be done.
QString setAside(const QString& path);

} // namespace lampblack
