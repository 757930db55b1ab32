// Loads and saves the scene together with its project.
#pragma once

#include "host/host.h"
#include "plugin/lit_layer.h"
#include "scene/scene_document.h"

namespace lampblack
{

class ProjectScene : public QObject
{
    Q_OBJECT

public:
    ProjectScene(Host& host, SceneDocument& document, const LitLayer& layer, QObject* parent = nullptr);
    ~ProjectScene() override;

    /// Asks before the window closes if the scene or the result layer is not saved and Pencil2D would not
    /// ask.
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    /// Ask the artist, if there is something to lose; false keeps the project open.
    bool mayLeave();
    void loadScene(const QString& path);
    bool saveAll();
    void fitToCanvas(const QSize& size);

    Host& mHost;
    SceneDocument& mDocument;
    const LitLayer& mLayer;
    bool mUntouched = true; ///< the project has no scene file: the default scene may follow the canvas size
};

} // namespace lampblack
