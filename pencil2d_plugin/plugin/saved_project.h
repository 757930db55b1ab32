// The project's file, as long as it holds what Pencil2D shows.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"

#include <optional>

namespace lampblack
{

class SavedProject : public QObject
{
    Q_OBJECT

public:
    SavedProject(Host& host, SceneDocument& document, QObject* parent = nullptr);

    /// The .pclx file; empty while it differs from what is shown, apart from the scene and the result layer.
    QString path() const;

private:
    /// The drawn layers. Whether they are visible does not matter for layers with a role.
    QStringList drawnLayers(const QVector<Layer>& layers) const;

    Host& mHost;
    SceneDocument& mDocument;
    // Pencil2D does not count a new, deleted or hidden layer as a change of the project.
    std::optional<QVector<Layer>> mSaved; ///< the layers at the last save
};

} // namespace lampblack
