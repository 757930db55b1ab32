// Rigs in files, on the clipboard, and those that come with Lampblack.
#pragma once

#include "scene/scene.h"
#include "user_error.h"

#include <QVector>

#include <optional>
#include <variant>

namespace lampblack
{

/// A rig as indented JSON, unknown fields included.
QByteArray textOf(const Rig& rig);

/// The rig that `text` holds; `source` names it in errors.
std::variant<Rig, UserError> rigFromText(const QByteArray& text, const QString& source);

std::variant<Rig, UserError> readRigFile(const QString& path);

/// Write the rig, whole or not at all.
std::optional<UserError> writeRigFile(const QString& path, const Rig& rig);

} // namespace lampblack
