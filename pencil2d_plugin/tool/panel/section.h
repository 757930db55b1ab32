// A part of the panel that can be folded.
#pragma once

#include <QToolButton>
#include <QVBoxLayout>
#include <QWidget>

namespace lampblack
{

class Section : public QWidget
{
    Q_OBJECT

public:
    /// The heading's objectName is `name`.
    Section(const QString& name, const QString& title, bool open, QWidget* parent = nullptr);

    QString name() const { return mHeading->objectName(); }
    QVBoxLayout* body() { return mBody; }
    bool isOpen() const { return mOpen; }
    void setOpen(bool open);
    void setTitle(const QString& title) { mHeading->setText(title); }

Q_SIGNALS:
    void toggled(bool open); ///< by the artist

private:
    QToolButton* mHeading;
    QWidget* mContent;
    QVBoxLayout* mBody;
    bool mOpen = true;
};

} // namespace lampblack
