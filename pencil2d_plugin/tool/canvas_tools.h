// What the artist works with on the canvas: lights and their menu, and in the Depth view cuts and brushes.
#pragma once

#include "tool/canvas/canvas_overlay.h"
#include "tool/canvas/frame_colours.h"
#include "tool/depth/cuts.h"

#include <QPointer>

namespace lampblack
{

class BrushBar;
class BrushEditor;
class CanvasInput;
class CutEditor;
class CutMenu;
class KeyInput;
class LampMenu;

/// Lays an overlay on the host's canvas and takes its pointer and keys. On a host without a canvas it does
/// nothing, and overlay() is null.
class CanvasTools : public QObject
{
    Q_OBJECT

public:
    /// `colours` are those of the current frame.
    CanvasTools(Host& host, SceneDocument& document, const FrameColours& colours, QObject* parent = nullptr);
    ~CanvasTools() override;

    CanvasOverlay* overlay() const { return mOverlay; }

    /// Take the pointer and the keys, or give them back.
    /// `depth`: the Depth view, in which cuts are corrected and the surface is shaped.
    void setListening(bool listening, bool depth);
    /// While picking, the next click on the canvas picks a colour.
    void setPicking(bool picking);
    bool isPicking() const;

    void setFrame(const FrameExport& frame);
    void setOverlaps(int frame, const QVector<Overlap>& overlaps);
    QVector<Cut> cuts() const; ///< those that are shown

Q_SIGNALS:
    void colourHovered(const QString& colour); ///< empty where nothing is drawn, or beside the canvas
    void colourPicked(const QString& colour);
    void pickingChanged(bool picking);
    void materialRequested(const QString& colour);
    void viewRequested(lampblack::Show view);

private:
    void setUpLights();
    void setUpDepth();
    void listen();
    QString colourAt(const QPoint& global) const;

    Host& mHost;
    const FrameColours& mColours;
    bool mListening = false;
    bool mDepth = false;
    // These belong to the host's window and may be deleted with it.
    QPointer<CanvasOverlay> mOverlay;
    QPointer<CanvasInput> mInput;
    QPointer<KeyInput> mKeys;
    QPointer<LampMenu> mMenu;
    QPointer<CutEditor> mCuts;
    QPointer<CutMenu> mCutMenu;
    QPointer<BrushEditor> mBrush;
    QPointer<BrushBar> mBrushBar;
};

} // namespace lampblack
