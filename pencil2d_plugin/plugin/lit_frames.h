// Which frames of the result layer no longer fit their drawing or the light.
#pragma once

#include "host/host.h"
#include "plugin/frame_feed.h"
#include "plugin/lit_layer.h"
#include "scene/scene_document.h"

#include <QMap>
#include <QTimer>

#include <functional>
#include <memory>

namespace lampblack
{

/// Remembers under which scene each frame of the layer was lit, and whether its drawing has changed since.
/// Frames of a project that is opened count as up to date. It tells the artist if the layer hides what is
/// drawn.
class LitFrames : public QObject
{
    Q_OBJECT

public:
    /// `pathOf` says where the lit picture of a frame lies.
    LitFrames(Host& host, FrameFeed& feed, const LitLayer& layer, SceneDocument& document,
              std::function<QString(int)> pathOf, QObject* parent = nullptr);

    /// These frames were lit under this scene, and are in the layer.
    void setLit(const QSet<int>& frames, const Scene& scene);

    int total() const;
    QVector<int> outdated() const; ///< rising

Q_SIGNALS:
    void changed();

private:
    struct Lit
    {
        std::shared_ptr<const Scene> scene;
        bool isRedrawn = false;
    };

    void findFrames();
    void setRedrawn(int frame, bool redrawn);
    void warnOfHiddenDrawing();

    Host& mHost;
    const LitLayer& mLayer;
    SceneDocument& mDocument;
    std::function<QString(int)> mPathOf;
    QMap<int, Lit> mFrames;
    QTimer mNews; ///< joins the changes of a moment
};

} // namespace lampblack
