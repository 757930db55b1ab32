// The scene follows its project: loaded with it, saved with it, never lost in silence.
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

    /// Asks before the window closes, or another project comes, over light or a layer of ours that the
    /// project's own question would not cover.
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    /// False keeps the project.
    bool mayLeave();
    void open(const QString& path);
    bool save();
    void fitCanvas(const QSize& size);

    Host& mHost;
    SceneDocument& mDocument;
    const LitLayer& mLayer;
    bool mFresh = true; ///< nobody has set this scene yet: it may follow the canvas's size
};

} // namespace lampblack
