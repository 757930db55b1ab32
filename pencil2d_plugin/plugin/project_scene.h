// The scene follows its project: loaded with it, saved with it, never lost in silence.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"

namespace lampblack
{

class ProjectScene : public QObject
{
    Q_OBJECT

public:
    ProjectScene(Host& host, SceneDocument& document, QObject* parent = nullptr);

    /// Asks before the window closes over light that the project's own question would not cover.
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void open(const QString& path);
    void fitCanvas(const QSize& size);

    Host& mHost;
    SceneDocument& mDocument;
    bool mFresh = true; ///< nobody has set this scene yet: it may follow the canvas's size
};

} // namespace lampblack
