// Lights that are ready to use, and lights of other shots.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"
#include "worker/worker.h"

#include <QMenu>

#include <functional>

namespace lampblack
{

/// Rigs as pictures; saving and loading lights; copying them to another project.
class RigMenu : public QMenu
{
    Q_OBJECT

public:
    RigMenu(Host& host, SceneDocument& document, QWidget* parent);

    /// Where the figure is, canvas pixels: the sets that come with Lampblack are laid on it. Empty:
    /// everywhere.
    void setFigure(std::function<QRectF()> figure) { mFigure = std::move(figure); }

    /// Show the sets by these pictures of the drawing; those without one by a ball in their light.
    void setPictures(const QVector<RigSketch>& sketches);
    int pictureSide() const; ///< of a picture, device pixels

Q_SIGNALS:
    void problem(const lampblack::UserError& error);

private:
    struct Preset
    {
        QString name; ///< as the worker calls it
        QAction* action;
        QIcon ball;
    };

    void addPresets();
    QAction* addEntry(const char* name, const QString& text, const QString& hint,
                      const std::function<void()>& onTriggered);
    void use(const Rig& rig, const QRectF& box = {});
    void save();
    void load();
    void copy() const;
    void paste();

    Host& mHost;
    SceneDocument& mDocument;
    std::function<QRectF()> mFigure;
    QVector<Preset> mPresets;
};

/// The rigs that come with Lampblack, in the order in which they are shown.
QVector<Rig> presetRigs();

/// A ball in the light of `rig`.
QIcon rigIcon(const Rig& rig, int side, double pixelRatio);

} // namespace lampblack
