// The light of the lit picture, put on whatever the canvas shows: it stays while the artist draws.
#pragma once

#include "tool/canvas/light_ratio.h"
#include "tool/canvas/lit_picture.h"

#include <QObject>
#include <QThreadPool>

namespace lampblack
{

/// Compares a lit picture with the drawing that it was made from, in another thread, and paints the
/// difference as light. A stroke that is drawn meanwhile is lit like what is beneath it.
class LightLayer : public QObject
{
    Q_OBJECT

public:
    explicit LightLayer(QObject* parent = nullptr);
    ~LightLayer() override;

    /// Take over the light of `picture`, whose drawing is known, as it is seen in this view. Changes nothing
    /// while that is what it shows.
    void follow(const LitPicture& picture, const QTransform& canvasToWidget, const QSize& view,
                const QColor& paper);
    void clear();

    /// Whether it has light for this frame.
    bool isReady(int frame) const { return !mRatio.isNull() && mFrame == frame; }

    void paint(QPainter& painter, const QTransform& canvasToWidget) const;

Q_SIGNALS:
    void changed();

private:
    LightRatio mRatio;
    int mFrame = 0;
    QPoint mPosition; ///< of the ratio's top left corner, widget pixels of mView
    QTransform mView; ///< canvas to widget
    quint64 mAsked = 0;
    QVector<qint64> mContent; ///< of what was last asked for
    QTransform mAskedView;
    QThreadPool mThread;
};

} // namespace lampblack
