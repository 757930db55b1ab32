// One line of the panel: the keys of a light or the floor.
#pragma once

#include "host/host.h"
#include "tool/panel/key_strip.h"

#include <QIcon>
#include <QLabel>
#include <QToolButton>

namespace lampblack
{

/// Name, strip, and buttons: to the key before, a key here or none, to the key after. Follows the host's time
/// and moves it; the keys themselves are the owner's affair.
class KeysRow : public QWidget
{
    Q_OBJECT

public:
    /// `name` begins the objectNames: "<name>.previous", ".here", ".next" and ".strip".
    KeysRow(const QString& name, Host& host, QWidget* parent = nullptr);

    /// Rising, each once.
    void setKeys(const QVector<int>& frames);

Q_SIGNALS:
    /// A key at the current frame is wanted, or no longer.
    void keyToggled();

protected:
    void changeEvent(QEvent* event) override;

private:
    void align();
    void drawIcons();
    void follow();
    int before() const; ///< the frame of the key before the current frame; 0 if there is none
    int after() const;

    Host& mHost;
    QVector<int> mFrames;
    QIcon mKey; ///< made once, for Qt keeps the pixmap of every icon that it painted
    QIcon mNoKey;
    QLabel* mLabel;
    KeyStrip* mStrip;
    QToolButton* mPrevious;
    QToolButton* mHere;
    QToolButton* mNext;
};

} // namespace lampblack
