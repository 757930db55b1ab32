// Reads the path of a camera while the artist is idle, a few frames at a time.
#pragma once

#include "host/camera_path.h"
#include "host/idleness.h"
#include "host/layer_rows.h"
#include "host/tool_palette.h"
#include "host/transport.h"

#include <QTimer>

namespace lampblack
{

/// Between two goes the current frame, layer and tool are the artist's.
class CameraSurvey : public QObject
{
    Q_OBJECT

public:
    static constexpr int MostFrames = 8; ///< that are read in one go

    CameraSurvey(const Parts& parts, Idleness* idleness, Transport* transport, ToolPalette* palette,
                 ViewReader* view);

    /// Read the camera layer in `row`, whose picture has this size, from its beginning. read() may be emitted
    /// at once.
    void begin(int row, const QSize& picture);
    void cancel();
    bool isReading() const { return mReading.has_value(); }

Q_SIGNALS:
    void read(const lampblack::CameraPath& path); ///< empty if it could not be read

private:
    void readOn();
    bool readSome();
    std::optional<QTransform> view() const;

    Parts mParts;
    Idleness* mIdleness;
    Transport* mTransport;
    ToolPalette* mPalette;
    ViewReader* mView;
    LayerRows mRows;
    std::optional<CameraReading> mReading;
    int mRow = 0;
    QSize mPicture;
    QTimer mTimer;
};

} // namespace lampblack
